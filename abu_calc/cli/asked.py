"""The command line that gives a result again, from what was asked for."""

import os
import shlex
import subprocess
from collections.abc import Iterator, Mapping
from inspect import Parameter
from typing import Any, get_args


def asked(name: str, parameters: Mapping[str, Parameter], given: Mapping[str, Any]) -> str:
    """The command with its arguments, and those options that are not as they are anyway; quoted for a shell."""
    words = [
        "abu",
        name,
        *(word for key, parameter in parameters.items() if key != "how" for word in _words(parameter, given[key])),
    ]
    return subprocess.list2cmdline(words) if os.name == "nt" else shlex.join(words)


def _words(parameter: Parameter, value: Any) -> Iterator[str]:
    """Command-line words of one parameter; none if its default is in force."""
    if value is None or value == parameter.default:
        return
    option = _option(parameter)
    for each in value if isinstance(value, (list, tuple)) else [value]:
        if option is None:
            yield str(each)
        elif isinstance(each, bool):
            yield option if each else option.replace("--", "--no-", 1)
        else:
            yield from (option, str(each))


def _option(parameter: Parameter) -> str | None:
    """Name of a parameter's option; None for an argument."""
    for extra in get_args(parameter.annotation)[1:]:
        # What is declared first stands where typer puts a default, as long as it has not looked at it.
        declared = (getattr(extra, "default", None), *(getattr(extra, "param_decls", None) or ()))
        flags = [each for each in declared if isinstance(each, str) and each.startswith("--")]
        if flags:
            return flags[0]
    return None
