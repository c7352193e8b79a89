"""Configuration of the documentation: MyST Markdown, outputs produced by the commands themselves."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

from abu_calc.version import __version__

project = "abu-calc"
author = "The abu-calc authors"
copyright = "The abu-calc authors"
release = version = __version__

extensions = ["myst_parser", "sphinx_copybutton", "command_output", "generated_reference", "validation_cases"]
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]
nitpicky = True

html_theme = "furo"
html_title = f"abu-calc {version}"
html_static_path = ["_static"]
html_css_files = ["wide-tables.css"]
html_copy_source = False
html_show_sourcelink = False
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True
