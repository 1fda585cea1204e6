"""From what students hand in to a gradebook, notes and feedback: nbgrader plug-ins and the class pipeline.

errors, cells  what went wrong, in words; ids and records of cells
roster         students.csv: who is in the course; enrolment: how it is made; worksheets: tables of platforms
term           term.toml: due dates and what being late costs
collecting/    from a platform's download to the folders of students
entries        what a verdict is in nbgrader's gradebook: a score and a comment
inert          makes what a student wrote harmless to look at
submission/    opens a submission strictly, restores it, runs it in the sandbox
files          files that are there whole or not at all; folders: which students have one
gradebook      nbgrader's gradebook, opened for one look or one change as a whole
store          the result of a submission and its mark, stored together; exercise: the cells of a release
plugins/       nbgrader's converters, preprocessors and exporters, as this course configures them
host           prepares a process that runs nbgrader
course         a course folder with nbgrader opened on it
crew           threads or processes that restore, run, judge and lay out submissions
cluster        a crew whose notebooks run on the workers of a Dask scheduler
pipeline       grades a class: a crew works side by side, one thread writes the gradebook
results        what was found, one line per submission
explain        how one verdict came about; changes: whose points moved when graded again
returning      grades and pages as platforms take them back
report/        the class report on one exercise; overview/: the term at a glance
points         what a question is worth
watch, archive what arrives; a term in one zip
release, bundle, doctor    the other commands; table shows results and report in a terminal
"""
