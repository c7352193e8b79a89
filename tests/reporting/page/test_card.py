"""Words and data as a page may hold them: nothing acts, nothing ends a script."""

import json
import re

import pytest

from abu_calc.reporting.page.card import beside, script, text


def test_no_word_is_an_element_or_acts() -> None:
    assert text('<b onclick="x">&') == "&lt;b onclick=&quot;x&quot;&gt;&amp;"
    assert text("a\x1b\u202e") == "a\\x1b\\u202e"


def test_data_cannot_end_the_script() -> None:
    hostile = "</script><script>alert(1)</script>"
    page = script("motion.js", title=hostile, values=[1.5, None])
    assert page.count("</script>") == 1 and page.endswith("</script>")
    given = re.search(r"const data = (.*);\n", page)
    assert given is not None and json.loads(given[1]) == {"title": hostile, "values": [1.5, None]}
    assert beside("motion.js") in page


def test_numbers_that_no_script_reads_are_refused() -> None:
    with pytest.raises(ValueError):
        script("motion.js", value=float("nan"))
