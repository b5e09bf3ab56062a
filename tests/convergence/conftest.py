"""Element counts and the exact answers of a uniform cantilever."""

import pytest

STIFFNESS_RULES = ["flexibility", "midpoint"]


@pytest.fixture(params=STIFFNESS_RULES)
def rule(request: pytest.FixtureRequest) -> str:
    """Both rules of joint stiffness."""
    return str(request.param)
