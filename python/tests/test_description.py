from __future__ import annotations

import pytest
import tomllib

import trunnion
from trunnion import ModelError


@pytest.mark.parametrize("name", trunnion.models())
def test_a_dict_is_its_model_file(name: str) -> None:
    model = trunnion.Model.from_catalogue(name)
    described = trunnion.Model.from_description(tomllib.loads(model.text))
    assert tomllib.loads(described.text) == tomllib.loads(model.text)
    assert described.derive().to_dict() == model.derive().to_dict()


def test_awkward_texts_stay_as_they_are() -> None:
    text = 'a "b" \\ \n\t\x7f \x01 é 𝄞'
    tables = tomllib.loads(trunnion.Model.from_catalogue("tilting-table-a").text)
    model = trunnion.Model.from_description(tables | {"title": text})
    assert tomllib.loads(model.text)["title"] == text


def test_what_is_no_description_is_refused() -> None:
    tables = tomllib.loads(trunnion.Model.from_catalogue("tilting-table-a").text)
    with pytest.raises(ModelError) as refused:
        trunnion.Model.from_description(tables | {"estimate": ["e_xq"]}, name="mine")
    assert refused.value.file == "mine"
    lines = trunnion._description.toml(tables | {"estimate": ["e_xq"]}).splitlines()
    assert lines[refused.value.line - 1].startswith("estimate")
    for wrong in [5, None, [1], {"name": object()}, {5: "x"}, {"axis": {"A": {"range": {1, 2}}}}]:
        with pytest.raises(TypeError):
            trunnion.Model.from_description(wrong)
    with pytest.raises(ModelError):
        trunnion.Model.from_description({})
    with pytest.raises(ModelError):
        trunnion.Model.from_description("\0")


def test_a_derivation_shows_itself() -> None:
    derivation = trunnion.Model.from_catalogue("tilting-table-a").derive()
    assert derivation.rank == len(derivation.base) - 2 == 11
    assert derivation.base["k1"] == "d_yz2 − d_yy2"
    assert derivation.functions == {"eps_xa": True}
    assert any("only appear" in words for words in derivation.confounded)
    latex = derivation._repr_latex_()
    assert latex.startswith("\\begin{align}") and latex.endswith("\\end{align}\n") and "%" not in latex
    assert derivation.latex().endswith(latex)


def test_what_is_not_determined_is_said() -> None:
    whole = trunnion.Setup.from_catalogue("rotary-table-c")
    few = whole.subset(["tangential", "c-radial-far", "c-tangential-far"])
    assert few.functions == whole.functions == ["ECC"]
    told = few.fit({run: whole.simulate().runs[run] for run in few.runs}).functions["ECC"]
    assert told.startswith("determined up to cos(c)")
