"""The examples in the documentation of the package are tests."""

import doctest
import re
import warnings

import pytest
import trueaxis
from trueaxis import _answers, _machine, _problems, _verbs


@pytest.mark.parametrize("module", [trueaxis, _answers, _machine, _problems, _verbs])
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
    for block in blocks:
        parsed = doctest.DocTestParser().get_doctest(block, {}, page, page, 0)
        if parsed.examples:
            assert doctest.DocTestRunner().run(parsed).failed == 0
        else:
            exec(compile(block, page, "exec"), {})
    assert trueaxis.__version__


def test_every_public_thing_is_described():
    for name in trueaxis.__all__:
        thing = getattr(trueaxis, name)
        if not isinstance(thing, str):
            assert thing.__doc__ and len(thing.__doc__) > 30, name
