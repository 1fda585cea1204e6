"""Our parts of nbgrader: preprocessors and exporters that nbgrader_config.py names, converters that `host` puts in place."""
