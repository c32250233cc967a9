"""The optimisers of `design.py`. Each searches the unit cube for the largest first goal, or for a front, until the budget is used up.

All begin with the spec as given. Limits enter by the optimiser's own handling of constraints: the violation must be zero. CMA-ES of Optuna
has none, so an infeasible design has minus its violation as value there, which is below every power.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from .design_evaluation import Evaluation, Evaluator
from .design_problems import Problem

#: Members of the populations: five for each of three keys. The defaults (45 and 100) leave room for one generation of these budgets.
POPULATION = 15
FRONT_POPULATION = 20


class BudgetUsedError(Exception):
    """All evaluations are used."""


@dataclass(frozen=True)
class Point:
    """An evaluated design, with the CPU and wall time since the start of the search, s."""

    place: tuple[float, ...]
    goals: tuple[float, ...]
    violation: float
    cpu_s: float
    wall_s: float


@dataclass
class Counted:
    """Evaluates designs up to a budget, each once, and keeps them in order."""

    evaluate: Evaluator
    budget: int
    points: list[Point] = field(default_factory=list)
    known: dict[tuple[float, ...], Evaluation] = field(default_factory=dict)
    cpu_begin_s: float = field(default_factory=time.process_time)
    wall_begin_s: float = field(default_factory=time.perf_counter)

    def __call__(self, place: Sequence[float]) -> Evaluation:
        """Returns the evaluation at a place, which is moved to the nearest one of the unit cube."""
        inside = tuple(min(max(float(each), 0.0), 1.0) for each in place)
        if inside in self.known:
            return self.known[inside]
        if len(self.points) >= self.budget:
            raise BudgetUsedError
        found = self.evaluate(inside)
        self.known[inside] = found
        cpu_s, wall_s = time.process_time() - self.cpu_begin_s, time.perf_counter() - self.wall_begin_s
        self.points.append(Point(inside, found.goals, found.violation, cpu_s, wall_s))
        return found


Search = Callable[[Problem, Counted, int], None]


def scipy_evolution(problem: Problem, counted: Counted, seed: int) -> None:
    """SciPy's differential evolution with its constraint (Lampinen 2002), from a Sobol sequence."""
    from scipy.optimize import NonlinearConstraint, differential_evolution

    size = len(problem.keys)
    limits = () if not problem.limits else NonlinearConstraint(lambda place: counted(place).violation, -1.0, 0.0)
    differential_evolution(
        lambda place: -problem.scale * counted(place).goals[0],
        [(0.0, 1.0)] * size,
        x0=problem.start(),
        constraints=limits,
        popsize=POPULATION // 3,
        init="sobol",
        maxiter=1000,
        tol=0.0,
        polish=False,
        rng=seed,
    )


def optuna_search(problem: Problem, counted: Counted, seed: int, is_tpe: bool) -> None:
    """Optuna with one of its samplers."""
    import optuna

    optuna.logging.set_verbosity(optuna.logging.ERROR)
    names = [key.path for key in problem.keys]

    def objective(trial: optuna.Trial) -> float:
        found = counted([trial.suggest_float(name, 0.0, 1.0) for name in names])
        if is_tpe and problem.limits:
            trial.set_constraint("limits", found.violation)
        return problem.scale * found.goals[0] if is_tpe or found.violation == 0.0 else -found.violation

    if is_tpe:
        sampler: optuna.samplers.BaseSampler = optuna.samplers.TPESampler(seed=seed)
    else:
        sampler = optuna.samplers.CmaEsSampler(seed=seed)
    study = optuna.create_study(direction="maximize", sampler=sampler)
    study.enqueue_trial(dict(zip(names, problem.start(), strict=True)))
    study.optimize(objective, n_trials=10 * counted.budget)


def pymoo_search(problem: Problem, counted: Counted, seed: int) -> None:
    """pymoo's genetic algorithm, or NSGA-II for several goals, with its constraint, from a Latin hypercube."""
    import numpy as np
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.core.problem import ElementwiseProblem
    from pymoo.optimize import minimize
    from scipy.stats import qmc

    size, goals, has_limits = len(problem.keys), len(problem.goals), bool(problem.limits)

    class Objective(ElementwiseProblem):
        def __init__(self) -> None:
            super().__init__(n_var=size, n_obj=goals, n_ieq_constr=int(has_limits), xl=np.zeros(size), xu=np.ones(size))

        def _evaluate(self, x: np.ndarray, out: dict[str, object], *args: object, **kwargs: object) -> None:
            found = counted(x.tolist())
            out["F"] = [-problem.scale * found.goals[0], *(-each for each in found.goals[1:])]
            if has_limits:
                out["G"] = [found.violation]

    members = POPULATION if goals == 1 else FRONT_POPULATION
    first = qmc.LatinHypercube(size, rng=seed).random(members)
    if goals == 1:
        first[0] = problem.start()
    method = GA(pop_size=members, sampling=first) if goals == 1 else NSGA2(pop_size=members, sampling=first)
    minimize(Objective(), method, ("n_gen", 1000), seed=seed)


PEERS: dict[str, Search] = {
    "differential evolution (SciPy)": scipy_evolution,
    "TPE (Optuna)": lambda problem, counted, seed: optuna_search(problem, counted, seed, True),
    "CMA-ES (Optuna)": lambda problem, counted, seed: optuna_search(problem, counted, seed, False),
    "genetic algorithm (pymoo)": pymoo_search,
}
FRONT_PEERS: dict[str, Search] = {"NSGA-II (pymoo)": pymoo_search}


def search(method: Search, problem: Problem, evaluate: Evaluator, budget: int, seed: int) -> Counted:
    """Returns all evaluated designs of a search with a budget."""
    counted = Counted(evaluate, budget)
    with contextlib.suppress(BudgetUsedError):
        method(problem, counted, seed)
    return counted
