"""How Sphinx makes the site of the pages in this folder; `make docs` calls it."""

import logging
import os
import sys
from pathlib import Path

import cointoss

HERE = Path(__file__).parent
MADE = HERE.parent / "out" / "docs"
"""What `make docs` computes for the site, and keeps for the next time."""
sys.path.insert(0, str(HERE / "extensions"))

project = "cointoss"
author = copyright = "The cointoss authors"
version = release = cointoss.__version__
root_doc = "index"
extensions = ["myst_nb", "sphinx_design", "sphinx.ext.autodoc", "docstrings", "pages", "figures"]
exclude_patterns = ["extensions", "made", "paper", "templates", "**.ipynb"]
# Quotes stay as they are written.
smartquotes_action = "D"
nitpicky = True
nitpick_ignore_regex = [("py:.*", r"(numpy|collections\.abc)\..*")]

html_theme = "furo"
html_title = f"cointoss {release}"
templates_path = ["templates"]
html_static_path = ["static"]
html_css_files = ["site.css"]
html_extra_path = [str(MADE / "pages")]
html_copy_source = False
# A page opened from the disk may not fetch others.
html_show_search_summary = False
html_show_sphinx = False

# The pages are plain Markdown, with the anchors that GitHub gives headings; what is indented is no Python.
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
highlight_language = "text"

nb_execution_mode = "cache"
nb_execution_cache_path = str(MADE / "notebooks")
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_merge_streams = True
# Notebooks know nothing of the user's own settings of IPython.
PROFILE = MADE / "ipython" / "profile_default" / "ipython_kernel_config.py"
PROFILE.parent.mkdir(parents=True, exist_ok=True)
PROFILE.write_text('c.IPKernelApp.log_level = "ERROR"\nc.InlineBackend.figure_formats = {"retina"}\n')
os.environ["IPYTHONDIR"] = str(MADE / "ipython")
# Furo's colours, when imported, let every library print its log, unless the logger is set up before.
logging.basicConfig(level=logging.WARNING, format="%(name)s: %(message)s")
# What a notebook writes to its standard error is a warning, and so ends `make docs`: no progress there.
os.environ["TQDM_DISABLE"] = "1"
nb_output_stderr = "warn"
# No widgets: their scripts would come from the network.
nb_ipywidgets_js: dict[str, dict[str, str]] = {}

# Signatures and types would be those of pydantic's fields; docstrings give meaning, frame, shape and unit.
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_preserve_defaults = True
autodoc_class_signature = "separated"
autodoc_default_options = {"exclude-members": "__init__, __new__, model_config"}
default_role = "code"
