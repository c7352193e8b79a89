"""Configuration of the documentation: MyST Markdown, outputs produced by the commands themselves."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

from abu_calc.version import __version__

project = "abu-calc"
author = "The abu-calc authors"
copyright = "The abu-calc authors"
release = version = __version__

extensions = [
    "myst_nb", "sphinx_copybutton", "command_output", "effect_prices", "generated_reference", "validation_cases",
    "for_agents",
]  # fmt: skip
# The notebook runs when the site is built, in a folder of its own; an error ends the build.
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_merge_streams = True
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3
exclude_patterns = ["_build", "jupyter_execute"]
nitpicky = True

html_theme = "furo"
html_title = f"abu-calc {version}"
html_static_path = ["_static"]
html_css_files = ["wide-tables.css"]
html_copy_source = False
html_show_sourcelink = False
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True
