"""Files of other programs, and a case for a turbine: the message says what they are."""

from __future__ import annotations

from pathlib import Path

import pytest

import offwind_pin as ow

OTHERS = {
    "main file of OpenFAST": (
        "------- OpenFAST INPUT FILE -------------------------------------------\n"
        "NREL 5.0 MW\n---------------------- SIMULATION CONTROL -------------\n"
        'False         Echo            - Echo input data\n"FATAL"  AbortLevel - Error level\n',
        "of OpenFAST",
    ),
    "ElastoDyn": (
        "------- ELASTODYN V1.03.* INDIVIDUAL MODULE INPUT FILE ----------\nNREL 5.0 MW\n",
        "of OpenFAST",
    ),
    "older file": (
        "------- FAST v8.16.* INPUT FILE ---------\nFAST of a monopile: \xb7\n",
        "of OpenFAST",
    ),
    "BModes": ("======   BModes v3.00 Main Input File  ======\n\n true Echo\n", "of BModes"),
    "windIO": (
        "name: IEA\nassembly:\n  turbine_class: I\ncomponents:\n  blade: {}\nmaterials: []\n",
        "windIO",
    ),
    "windIO, later": ("windIO_version: '2.0'\nassembly: {}\n", "windIO"),
    "options of WISDEM": ("General:\n  verbosity: false\nWISDEM:\n  RotorSE: {}\n", "of WISDEM"),
    "HAWC2": ("begin simulation;\n  time_stop 700.0 ;\nend simulation;\n", "of HAWC2"),
}


@pytest.mark.parametrize("other", OTHERS)
def test_files_of_other_programs(tmp_path: Path, other: str) -> None:
    """No hint to remove a key of theirs, but what can be done."""
    text, said = OTHERS[other]
    path = tmp_path / "other.yaml"
    path.write_bytes(text.encode("latin-1"))
    for load in (ow.load_turbine, ow.load_case):
        with pytest.raises(ow.InputError, match=rf"other\.yaml: got an?.*{said}.*turbine file"):
            load(path)


def test_cases_and_turbines(tmp_path: Path) -> None:
    """Each given for the other; a file that is neither keeps its own message."""
    package = Path(ow.__file__).parent
    with pytest.raises(ow.InputError, match=r"a case file; allowed: a turbine file.*offwind run"):
        ow.load_turbine(package / "cases" / "oc6_phase2" / "lc2.1.yaml")
    with pytest.raises(ow.InputError, match=r"a turbine file; allowed: a case file"):
        ow.load_case(package / "definitions" / "library" / "oc6_phase2.yaml")
    (tmp_path / "own.yaml").write_text("nam: a\n")
    with pytest.raises(ow.InputError, match="unknown key"):
        ow.load_turbine(tmp_path / "own.yaml")
