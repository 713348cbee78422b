"""The examples in the documentation of the package are tests."""

import doctest
import re
import runpy
import warnings
from pathlib import Path

import pytest
import trueaxis
from trueaxis import _answers, _compensate, _describe, _identify, _machine, _measurement, _poses, _problems


MODULES = [trueaxis, _answers, _compensate, _describe, _identify, _machine, _measurement, _poses, _problems]


@pytest.mark.parametrize("module", MODULES)
def test_examples_of_the_package(module):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", trueaxis.TrueAxisWarning)
        failed, tried = doctest.testmod(module, extraglobs={"trueaxis": trueaxis})
    assert failed == 0 and tried > 0


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
def test_examples_of_a_page(page):
    text = open(page, encoding="utf-8").read()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    names = {}
    for block in blocks:
        parsed = doctest.DocTestParser().get_doctest(block, names, page, page, 0)
        if parsed.examples:
            assert doctest.DocTestRunner().run(parsed, clear_globs=False).failed == 0
            names = parsed.globs
        else:
            exec(compile(block, page, "exec"), {})
    assert trueaxis.__version__


def test_types_of_documents_are_those_of_the_schemas():
    made = runpy.run_path("crates/trueaxis-python/documents.py")["written"]()
    place = Path("crates/trueaxis-python/python/trueaxis/documents.py")
    assert place.read_text(encoding="utf-8") == made, "run crates/trueaxis-python/documents.py"


@pytest.mark.filterwarnings("ignore::trueaxis.TrueAxisWarning")
def test_a_document_has_the_entries_of_its_type():
    answer = trueaxis.simulate("machines/i5-engraver/machine.toml", "examples/02_simulate/ring-fanuc.nc")
    assert set(answer.to_dict()) <= set(trueaxis.documents.SimulateDocument.__annotations__)


def test_every_public_thing_is_described():
    for name in trueaxis.__all__:
        thing = getattr(trueaxis, name)
        if not isinstance(thing, str):
            assert thing.__doc__ and len(thing.__doc__) > 30, name
