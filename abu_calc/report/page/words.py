"""Words as a page may hold them."""

from html import escape

from abu_calc.escapes import escaped


def text(words: str) -> str:
    """Nothing in them is an element, or acts."""
    return escape(escaped(words), quote=True)
