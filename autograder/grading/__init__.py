"""From what students hand in to a gradebook, notes and feedback: nbgrader plug-ins and the class pipeline.

entries        what a verdict is in nbgrader's gradebook: a score and a comment
inert          makes what a student wrote harmless to look at
submission/    opens a submission strictly, restores it, runs it in the sandbox
plugins/       nbgrader's converters, preprocessors and exporters, as this course configures them
host           prepares a process that runs nbgrader
course         a course folder with nbgrader opened on it
pipeline       grades a class: kernels side by side, gradebook by one thread
results        what was found, one line per submission
report/        the class report
release, bundle, doctor    the other commands; table shows results and report in a terminal
"""
