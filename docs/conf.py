"""The site of the course: `make site` writes it to build/site.

Its pages are the files of the repository where they lie: lectures and exercises are executed as they are, texts that stand
elsewhere (README, CONTRIBUTING, CHANGELOG) are included, never copied. Nothing in a page is fetched from another server.
"""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path.insert(0, str(HERE / "extensions"))


def github_repository() -> str:
    """Owner and name of the repository on GitHub, for the buttons of notebooks; empty where it is on no such server.

    GitHub Actions and ``make site REPOSITORY=owner/name`` tell it, else the clone's own origin does.
    """
    if told := os.environ.get("REPOSITORY") or os.environ.get("GITHUB_REPOSITORY"):
        return told
    command = ["git", "-C", str(ROOT), "remote", "get-url", "origin"]
    origin = subprocess.run(command, capture_output=True, text=True).stdout.strip().removesuffix(".git")
    return "/".join(origin.replace(":", "/").split("/")[-2:]) if "github.com" in origin else ""


REPOSITORY = github_repository()

project = "A robotics course that grades itself"
author = "The authors of this course"
project_copyright = "code BSD-3-Clause, text and pictures CC BY 4.0"
root_doc = "docs/index"
include_patterns = [
    "docs/*.md",
    "course/*.ipynb",
    "exercises/*/*.ipynb",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
]
exclude_patterns = ["**/.ipynb_checkpoints", ".venv*", "build", "**/node_modules"]
extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_design",
    "sphinx_copybutton",
    "formulas",
    "scenes",
    "statements",
    "elsewhere",
]

myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "dollarmath", "html_image", "substitution"]
myst_substitutions = {"repository": REPOSITORY or "OWNER/REPOSITORY"}
myst_heading_anchors = 3
myst_links_external_new_tab = False
suppress_warnings = [
    "mystnb.unknown_mime_type",  # answers as data, which `check` displays for the grader
    "ref.python",  # words such as count in "count of ..." that are attributes of several classes
]

# Scenes come as a page can show them: see `dhkit.scene`.
os.environ["DHKIT_SCENES"] = "embedded"
nb_execution_mode = "cache"
nb_execution_cache_path = str(ROOT / "build/executed")
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_ipywidgets_js = {}  # their program would come from another server: see `dhkit.flipbook`
nb_merge_streams = True
nb_render_markdown_format = "myst"

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # numpydoc sections name the types
autodoc_default_options = {"members": True, "show-inheritance": True}
napoleon_google_docstring = False
napoleon_use_ivar = True
add_module_names = False
toc_object_entries_show_parents = "hide"
default_role = "code"  # single backquotes of numpydoc

html_theme = "sphinx_book_theme"
html_title = project
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["front"]
html_copy_source = True
html_show_sourcelink = False
html_context = {"default_mode": "auto"}  # light or dark as the reader's system is
html_theme_options = {
    "use_download_button": True,
    "use_fullscreen_button": True,
    "use_sidenotes": False,
    "home_page_in_toc": True,
    "navbar_persistent": [],
    "show_navbar_depth": 1,
    "show_toc_level": 2,
}
if REPOSITORY:
    html_theme_options |= {
        "repository_url": f"https://github.com/{REPOSITORY}",
        "repository_branch": os.environ.get("GITHUB_REF_NAME", "main"),
        "use_repository_button": True,
        "use_issues_button": True,
        "use_source_button": True,
        "launch_buttons": {
            "colab_url": "https://colab.research.google.com",
            "binderhub_url": "https://mybinder.org",
            "notebook_interface": "jupyterlab",
        },
    }
