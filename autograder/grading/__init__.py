"""From what students hand in to a gradebook, notes and feedback: nbgrader plug-ins and the class pipeline.

reading        opens a submission strictly and bounded
restore        gives it back the cells that are not the student's to change
execution      runs it in the sandbox and gathers the evidence
preprocessors  the plug-ins that nbgrader_config.py names: restore, execute, judge, note, summarize
converters     nbgrader's converters for submissions that nobody has looked at
pipeline       grades a class: kernels side by side, gradebook by one thread
results        what was found, one line per submission
release, report, export, bundle, doctor    the other commands
"""
