"""The term at a glance: every student and the class over all exercises.

standing   who did what, who is falling behind, which mistakes stay
minutes    how long questions took, where notebooks tell
likeness   equal wrong answers of two students, against what chance gives
answers    wrong answers in graded notebooks, and when two are the same
reading    all of it from gradebook, roster, receipts and notebooks
page       one page for the class, one per student, one with what is alike
"""
