"""Signals aimed at imports: a hook in the import system of a process sends itself one while a module loads.

`aimed(folder, module, name)` writes a `sitecustomize.py`; with the folder first on PYTHONPATH, Python runs it before
anything else. The signal comes from inside the module's own code, as extension modules meet it. A file `sent` in the
working folder tells that it was sent.
"""

from pathlib import Path

HOOK = '''\
import os, signal, sys
from importlib.machinery import PathFinder


class Sending:
    """The loader of one module, which sends the signal before the module's code or after it."""

    def __init__(self, loader):
        self.loader = loader

    def create_module(self, spec):
        return self.loader.create_module(spec)

    def exec_module(self, module):
        if {before}:
            send()
        self.loader.exec_module(module)
        if not {before}:
            send()

    def __getattr__(self, name):
        return getattr(self.loader, name)


def send():
    sys.meta_path[:] = [each for each in sys.meta_path if not isinstance(each, Finder)]
    open("sent", "w").close()
    try:
        os.kill(os.getpid(), signal.{signal})
        sum(range(1000))  # the handler runs here
    except BaseException as error:  # as Cython's and NumPy's modules do
        raise ImportError("numpy._core.multiarray failed to import") from None


class Finder:
    """Finds one module, for which it is asked once."""

    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name != {module!r}:
            return None
        spec = PathFinder.find_spec(name, path, target)
        if spec is not None and spec.loader is not None:
            spec.loader = Sending(spec.loader)
        return spec


sys.meta_path.insert(0, Finder())
'''


def aimed(folder: Path, module: str, signal: str, *, before: bool = True) -> None:
    """Write the hook: this signal, while that module loads."""
    folder.mkdir(parents=True, exist_ok=True)
    text = HOOK.format(module=module, signal=signal, before=before)
    (folder / "sitecustomize.py").write_text(text, encoding="utf-8")
