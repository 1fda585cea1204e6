"""What a process that runs nbgrader needs before it does; nbgrader_config.py calls `prepare`."""

from __future__ import annotations

import os
import sys
import warnings
from pathlib import Path

from sqlalchemy.exc import SAWarning


def prepare() -> None:
    """Make nbgrader work without an activated environment, and use our converters in place of its own.

    A new gradebook starts a bare ``alembic`` found on PATH, so the interpreter's own folder must stand there first.
    Calling it again changes nothing.
    """
    scripts = str(Path(sys.executable).parent)
    if os.environ.get("PATH", "").split(os.pathsep)[0] != scripts:
        os.environ["PATH"] = os.pathsep.join(filter(None, (scripts, os.environ.get("PATH"))))

    # nbgrader 0.9.6 builds its rows in an order that SQLAlchemy 2 remarks upon; what is stored is right.
    warnings.filterwarnings("ignore", category=SAWarning, message="Object of type .* not in session")

    import nbgrader.apps.api
    import nbgrader.apps.autogradeapp
    import nbgrader.apps.generateassignmentapp
    import nbgrader.apps.generatefeedbackapp

    from .plugins.assignment import AssignmentRelease
    from .plugins.autograde import SubmissionAutograde
    from .plugins.feedback import FeedbackPages

    nbgrader.apps.api.GenerateAssignment = nbgrader.apps.generateassignmentapp.GenerateAssignment = AssignmentRelease
    nbgrader.apps.api.Autograde = nbgrader.apps.autogradeapp.Autograde = SubmissionAutograde
    nbgrader.apps.api.GenerateFeedback = nbgrader.apps.generatefeedbackapp.GenerateFeedback = FeedbackPages
