"""nbgrader's configuration of this course.

With it the stock commands (generate_assignment, autograde, generate_feedback, export) and formgrader give the
same scores, notes and feedback as the `autograder` command. Limits of the sandbox can be set here too, for
example `c.SandboxExecute.cell_seconds = 60`.
"""

from autograder.grading.host import prepare

prepare()

c = get_config()  # noqa: F821

c.CourseDirectory.source_directory = "solutions"
c.CourseDirectory.release_directory = "exercises"

c.ClearSolutions.code_stub = {"python": "# your code here"}

# Restored cells have the metadata of the released notebook, which was checked when it was released.
c.Autograde.sanitize_preprocessors = ["autograder.grading.plugins.preprocessors.RestoreCells"]
c.Autograde.autograde_preprocessors = [
    "autograder.grading.plugins.preprocessors.SandboxExecute",
    "autograder.grading.plugins.preprocessors.JudgeAnswers",
    "nbgrader.preprocessors.LimitOutput",
]

c.GenerateFeedback.exporter_class = "autograder.grading.plugins.feedback.FeedbackExporter"
c.GenerateFeedback.preprocessors = [
    "autograder.grading.plugins.preprocessors.Summarize",
    "nbconvert.preprocessors.CSSHTMLHeaderPreprocessor",
]

# Formgrader and feedback pages show what students wrote: nothing in it may act. Graded notebooks hold no HTML or
# script output; what is left is Markdown. (sanitize_html would also escape the paragraphs of our own feedback.)
# What it costs to lay a page out is bounded, too.
c.HTMLExporter.filters = {
    name: f"autograder.grading.rendering.{name}"
    for name in ("markdown2html", "highlight_code", "ansi2html", "clean_html", "strip_files_prefix")
}

# Due dates and penalties: term.toml
c.AssignLatePenalties.plugin_class = "autograder.grading.plugins.late.TermPenalty"

c.ExportApp.plugin_class = "autograder.grading.plugins.export.GradesAndNotes"
