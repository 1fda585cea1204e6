"""What the questions of several exercises need: one module per subject."""
