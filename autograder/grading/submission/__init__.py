"""What a student handed in: read strictly (reading), given back what is not theirs to change (restore), run (execution)."""
