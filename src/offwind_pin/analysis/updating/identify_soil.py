"""Identification of soil parameters, or of any number of a definition, from measured responses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2
from scipy.stats.qmc import Halton

from offwind_pin.analysis.updating.definition_path import number_at, with_number
from offwind_pin.analysis.updating.targets import Responses, Target
from offwind_pin.base.definition import Array
from offwind_pin.base.descriptions import one_line
from offwind_pin.base.errors import InputError
from offwind_pin.definitions.element import Element
from offwind_pin.definitions.turbine import Turbine
from offwind_pin.loads.sea.sea import Sea
from offwind_pin.structure.chain import Elements

UNTOLD = 1 / np.sqrt(12)
"""Standard error of a combination, in shares of the parameters' ranges, above which the data do not
determine it: the standard deviation of a uniform distribution over the range, which follows from
the bounds alone."""
NUMERICAL_RANK = 1e-6
"""Singular value over the largest one below which it is zero: the accuracy of differences of
responses that are solved to 1e-10."""
SIGNIFICANCE = 0.05
"""Probability of a larger chi-square below which the targets are inconsistent with the model."""
_STEP = 1e-4
"""Step of finite differences, as a share of a parameter's range."""
_AT_BOUND = 1e-4
"""Distance from a bound, as a share of the range, within which the parameter is at the bound."""
_TOLERANCE = 1e-6
"""Tolerance of the least squares: relative change of the sum, and of the parameters."""
_ALONE = 0.99
"""Share of one parameter in a combination above which the combination has its name."""


@dataclass(frozen=True)
class Parameter:
    """A number of the definition to be found between two bounds.

    Attributes
    ----------
    path : str
        Dotted, such as ``"soil.distributed_springs.curve.initial_modulus.gradient"``.
    lower, upper : float
        Bounds.
    start : float or None
        Start of the search; by default the turbine's value, or the middle if that is out of bounds.
    log : bool
        Whether to search over the logarithm, for numbers of unknown order of magnitude.
    """

    path: str
    lower: float
    upper: float
    start: float | None = None
    log: bool = True

    __repr__ = one_line

    def __post_init__(self) -> None:
        where = f"parameter {self.path!r}"
        bounds = (self.lower, self.upper)
        if not (np.all(np.isfinite(bounds)) and self.lower < self.upper):
            raise InputError(where, bounds, "finite bounds, lower before upper", "Correct them.")
        if self.log and self.lower <= 0:
            raise InputError(
                where, self.lower, "a lower bound above zero", "Raise it, or set log=False."
            )
        if self.start is not None and not self.lower <= self.start <= self.upper:
            allowed = f"{self.lower} to {self.upper}"
            raise InputError(f"{where}, start", self.start, allowed, "Start within the bounds.")

    @property
    def name(self) -> str:
        """Last two steps of the path."""
        return ".".join(self.path.split(".")[-2:])

    def value(self, share: float) -> float:
        """Value at a fraction of the range.

        Parameters
        ----------
        share : float
            From 0 to 1.

        Returns
        -------
        float
        """
        if self.log:
            return float(self.lower * (self.upper / self.lower) ** share)
        return self.lower + share * (self.upper - self.lower)

    def share(self, value: float) -> float:
        """Fraction of the range at a value.

        Parameters
        ----------
        value : float

        Returns
        -------
        float
            From 0 to 1.
        """
        if self.log:
            return float(np.log(value / self.lower) / np.log(self.upper / self.lower))
        return (value - self.lower) / (self.upper - self.lower)


@dataclass(frozen=True)
class FoundParameter:
    """Result for a parameter.

    standard_error : of the value, from the targets' uncertainties; infinite if the data do not
        determine it
    identifiable : whether the data determine it
    bound : ``"lower"`` or ``"upper"`` if the value is at this bound, else None
    """

    parameter: Parameter
    value: float
    standard_error: float
    identifiable: bool
    bound: str | None


@dataclass(frozen=True, eq=False)
class FoundTarget:
    """Result for a target.

    found : (k,) response of the model; distance : (k,) found minus wanted over the uncertainty
    """

    target: Target
    found: Array
    distance: Array


@dataclass(frozen=True, eq=False)
class SoilIdentification:
    """Outcome of an identification.

    Attributes
    ----------
    turbine : Turbine
        The definition with the identified numbers.
    parameters : tuple of FoundParameter
        Results for the parameters, in the order given.
    targets : tuple of FoundTarget
        Results for the targets, in the order given.
    jacobian : (m, p) array
        Derivatives of the distances of all targets by the parameters' shares of their ranges.
    sensitivity : (m, p) array
        Relative change of each response per relative change of each parameter.
    covariance : (p, p) array
        Covariance of the shares, for the determined combinations only.
    singular_values : (p,) array
        Singular values of the Jacobian: one over the standard error of a combination, in shares.
    combinations : (p, p) array
        Rows are the corresponding combinations of shares.
    chi_square : float
        Sum of squared distances.
    degrees_of_freedom : int
        Number of responses minus determined combinations.
    probability : float
        Probability of a larger chi-square; NaN without degrees of freedom.
    evaluations : int
        Number of models solved.
    verdict : str
        The result in words.
    """

    turbine: Turbine
    parameters: tuple[FoundParameter, ...]
    targets: tuple[FoundTarget, ...]
    jacobian: Array
    sensitivity: Array
    covariance: Array
    singular_values: Array
    combinations: Array
    chi_square: float
    degrees_of_freedom: int
    probability: float
    evaluations: int
    verdict: str

    __repr__ = one_line

    @property
    def identifiable(self) -> bool:
        """Whether the data determine every parameter."""
        return all(parameter.identifiable for parameter in self.parameters)

    @property
    def meets_targets(self) -> bool:
        """Whether the targets are met within their uncertainties."""
        if self.degrees_of_freedom > 0:
            return self.probability >= SIGNIFICANCE
        return self.chi_square <= chi2.isf(SIGNIFICANCE, len(self.jacobian))


def identify_soil(
    turbine: Turbine,
    targets: Sequence[Target],
    parameters: Sequence[Parameter],
    *,
    foundation: str = "distributed_springs",
    sea: Sea | None = None,
    element: Element = "euler_bernoulli",
    elements: Elements = None,
    starts: int = 1,
    progress: Callable[[int, float], None] | None = None,
) -> SoilIdentification:
    """Fit numbers of a definition to responses by bounded least squares on the full model.

    The sum of squared distances, each over its uncertainty, is minimised by a trust-region method
    (SciPy's ``least_squares``). Identifiability is judged at the minimum by the singular values of
    the Jacobian.

    Parameters
    ----------
    turbine : Turbine
        Definition to start from.
    targets : sequence of Target
        Responses to be met: :class:`FrequencyTarget`, :class:`DeflectionTarget`,
        :class:`ShapeTarget`.
    parameters : sequence of Parameter
        Numbers to identify; the rest of the definition does not change.
    foundation : str
        As for :func:`build`.
    sea : Sea, optional
        As for :func:`build`.
    element : {"euler_bernoulli", "timoshenko"}
        As for :func:`build`.
    elements : int, dict of str to int, or None
        As for :func:`build`.
    starts : int
        Number of searches, of which the best is kept: the first from the parameters' starts,
        further ones from points spread over the ranges (Halton sequence), to avoid local minima.
    progress : callable, optional
        Called with the number of models solved and half the sum of squares after each.

    Returns
    -------
    SoilIdentification

    Raises
    ------
    InputError
        Nothing to fit, an unknown path, or a number that the definition does not allow.
    SolverError
        A model without equilibrium, for example with too weak a soil.
    """
    if not targets or not parameters:
        given = f"{len(targets)} targets and {len(parameters)} parameters"
        raise InputError("identify_soil", given, "at least one of each", "Add what is missing.")
    if starts < 1:
        raise InputError("starts", starts, "1 or more", "Correct it.")
    paths = [parameter.path for parameter in parameters]
    if len(set(paths)) < len(paths):
        raise InputError("parameters", paths, "each path once", "Remove the duplicate.")
    fit = _Fit(
        turbine,
        targets,
        parameters,
        lambda changed: Responses(changed, foundation, sea, element, elements),
        progress,
    )
    first = np.array([_start(turbine, parameter) for parameter in parameters])
    spread = Halton(len(parameters), scramble=False).random(starts)[1:]
    searches = [fit.search(start) for start in (first, *spread)]
    return fit.outcome(min(searches, key=fit.cost))


def _start(turbine: Turbine, parameter: Parameter) -> float:
    """Share of the range at which to start, away from the bounds."""
    present = number_at(turbine, parameter.path)
    if parameter.start is not None:
        share = parameter.share(parameter.start)
    elif parameter.lower <= present <= parameter.upper:
        share = parameter.share(present)
    else:
        share = 0.5
    return float(np.clip(share, 0.01, 0.99))


class _Fit:
    """The model as a function of the parameters' shares of their ranges."""

    def __init__(
        self,
        turbine: Turbine,
        targets: Sequence[Target],
        parameters: Sequence[Parameter],
        solve: Callable[[Turbine], Responses],
        progress: Callable[[int, float], None] | None,
    ) -> None:
        self.turbine = turbine
        self.targets = targets
        self.parameters = parameters
        self.solve = solve
        self.progress = progress
        self.evaluations = 0
        self.wanted = np.concatenate([target.wanted for target in targets])
        self.uncertainty = np.concatenate(
            [np.full(len(target.wanted), target.uncertainty) for target in targets]
        )
        self._last: tuple[bytes, Array] | None = None

    def changed(self, shares: Array) -> Turbine:
        turbine = self.turbine
        for parameter, share in zip(self.parameters, shares, strict=True):
            turbine = with_number(turbine, parameter.path, parameter.value(float(share)))
        return turbine

    def distances(self, shares: Array) -> Array:
        """(m,) found minus wanted over the uncertainties."""
        key = shares.tobytes()
        if self._last is None or self._last[0] != key:
            responses = self.solve(self.changed(shares))
            found = np.concatenate([target.found(responses) for target in self.targets])
            self._last = key, (found - self.wanted) / self.uncertainty
            self.evaluations += 1
            if self.progress is not None:
                self.progress(self.evaluations, float(self._last[1] @ self._last[1]) / 2)
        return self._last[1]

    def cost(self, shares: Array) -> float:
        """Half the sum of the squared distances."""
        return float(self.distances(shares) @ self.distances(shares)) / 2

    def search(self, start: Array) -> Array:
        """(p,) shares of the nearest minimum."""
        result = least_squares(
            self.distances,
            start,
            self.forward_differences,
            bounds=(0, 1),
            method="trf",
            ftol=_TOLERANCE,
            xtol=_TOLERANCE,
        )
        return np.clip(result.x, 0, 1)

    def forward_differences(self, shares: Array) -> Array:
        """(m, p) derivatives by the shares for the search; steps point inwards."""
        here = self.distances(shares)
        columns = []
        for i, share in enumerate(shares):
            step = _STEP if share < 0.5 else -_STEP
            columns.append((self.distances(shares + step * _unit(i, len(shares))) - here) / step)
        return np.array(columns).T

    def central_differences(self, shares: Array) -> Array:
        """(m, p) derivatives by the shares to second order; at a bound from inside."""
        middle = np.clip(shares, _STEP, 1 - _STEP)
        columns = []
        for i in range(len(shares)):
            step = _STEP * _unit(i, len(shares))
            columns.append(
                (self.distances(middle + step) - self.distances(middle - step)) / (2 * _STEP)
            )
        return np.array(columns).T

    def outcome(self, shares: Array) -> SoilIdentification:
        distances = self.distances(shares)
        jacobian = self.central_differences(shares)
        _, values, combinations = np.linalg.svd(jacobian, full_matrices=True)
        singular = np.zeros(len(shares))
        singular[: len(values)] = values
        singular[singular < NUMERICAL_RANK * singular[0]] = 0.0
        told = singular * UNTOLD > 1
        kept = combinations[told]
        covariance = kept.T @ np.diag(1 / singular[told] ** 2) @ kept
        found = tuple(
            self._parameter(i, float(share), covariance, combinations, singular)
            for i, share in enumerate(shares)
        )
        total = float(distances @ distances)
        freedom = len(distances) - int(told.sum())
        outcome = SoilIdentification(
            turbine=self.changed(shares),
            parameters=found,
            targets=self._targets(distances),
            jacobian=jacobian,
            sensitivity=self._sensitivity(jacobian, distances, shares),
            covariance=covariance,
            singular_values=singular,
            combinations=combinations,
            chi_square=total,
            degrees_of_freedom=freedom,
            probability=float(chi2.sf(total, freedom)) if freedom > 0 else float("nan"),
            evaluations=self.evaluations,
            verdict="",
        )
        return replace(outcome, verdict=_in_words(outcome))

    def _parameter(
        self, i: int, share: float, covariance: Array, combinations: Array, singular: Array
    ) -> FoundParameter:
        parameter = self.parameters[i]
        untold = singular * UNTOLD <= 1
        open_share = float(np.sum(combinations[untold, i] ** 2))
        error = float(np.sqrt(covariance[i, i]))
        identifiable = open_share < 1 - _ALONE and error < UNTOLD
        bound = "lower" if share < _AT_BOUND else "upper" if share > 1 - _AT_BOUND else None
        return FoundParameter(
            parameter=parameter,
            value=parameter.value(share),
            standard_error=_slope(parameter, share) * error if identifiable else float("inf"),
            identifiable=identifiable,
            bound=bound,
        )

    def _targets(self, distances: Array) -> tuple[FoundTarget, ...]:
        sizes = [len(target.wanted) for target in self.targets]
        parts = np.split(distances, np.cumsum(sizes)[:-1])
        return tuple(
            FoundTarget(target, target.wanted + target.uncertainty * part, part)
            for target, part in zip(self.targets, parts, strict=True)
        )

    def _sensitivity(self, jacobian: Array, distances: Array, shares: Array) -> Array:
        """(m, p) d ln response / d ln parameter; NaN for a response of zero."""
        response = self.wanted + self.uncertainty * distances
        relative = np.full_like(response, np.nan)
        np.divide(self.uncertainty, response, out=relative, where=response != 0)
        values = [p.value(float(s)) for p, s in zip(self.parameters, shares, strict=True)]
        slopes = [_slope(p, float(s)) for p, s in zip(self.parameters, shares, strict=True)]
        return jacobian * relative[:, None] * np.array(values) / np.array(slopes)


def _slope(parameter: Parameter, share: float) -> float:
    """Derivative of a parameter's value by its share."""
    if parameter.log:
        return parameter.value(share) * float(np.log(parameter.upper / parameter.lower))
    return parameter.upper - parameter.lower


def _unit(i: int, count: int) -> Array:
    return np.eye(count)[i]


def _in_words(outcome: SoilIdentification) -> str:
    """Determined parameters, active bounds, and whether the targets are met."""
    lines = []
    names = [found.parameter.name for found in outcome.parameters]
    for found in outcome.parameters:
        if found.identifiable:
            lines.append(
                f"{found.parameter.name} = {found.value:.4g} +- {found.standard_error:.2g}."
            )
        else:
            lines.append(f"{found.parameter.name} is not identifiable from these targets.")
        if found.bound is not None:
            limit = getattr(found.parameter, found.bound)
            lines.append(f"{found.parameter.name} is at its {found.bound} bound {limit:.4g}.")
    if not outcome.identifiable:
        for value, row in zip(outcome.singular_values, outcome.combinations, strict=True):
            what = _combination(row, names)
            if value * UNTOLD > 1:
                lines.append(f"Determined to within {1 / value:.2g} of the range: {what}.")
            else:
                lines.append(f"Not determined by the data: {what}.")
    worst = max(outcome.targets, key=lambda found: float(np.max(np.abs(found.distance))))
    far = worst.distance[int(np.argmax(np.abs(worst.distance)))]
    fit = f"chi-square {outcome.chi_square:.3g}"
    if outcome.degrees_of_freedom > 0:
        freedom = f"{outcome.degrees_of_freedom} degree" + "s" * (outcome.degrees_of_freedom > 1)
        fit += f" with {freedom} of freedom, probability {outcome.probability:.2g}"
    lines.append(
        f"The targets are {'met' if outcome.meets_targets else 'not met'} within their "
        f"uncertainties ({fit}); farthest is {worst.target.name}, {far:+.2g} standard deviations."
    )
    return " ".join(lines)


def _combination(row: Array, names: list[str]) -> str:
    """A combination of shares: one parameter by its name, or several with their weights."""
    lead = int(np.argmax(np.abs(row)))
    if row[lead] ** 2 >= _ALONE:
        return f"{names[lead]} alone"
    signed = row * np.sign(row[lead])
    terms = [
        f"{weight:+.2f} {name}"
        for weight, name in zip(signed, names, strict=True)
        if abs(weight) >= 0.05
    ]
    return "the combination " + " ".join(terms) + " (of shares of the ranges)"
