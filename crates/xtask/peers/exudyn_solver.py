"""Exudyn with the settings that were fastest for it at equal error.

The build without range checks; no files, one thread, fixed steps. Tight Newton tolerances,
because with the default ones the error stops falling at some 1e-4, and modified Newton. Where the
mechanism passes through singular positions or a user function reads a reaction, that fails: there
the default tolerances and full Newton are used. The sparse solver from some 30 unknowns on,
reusing its pattern.
"""

import sys

import serving  # noqa: F401  (takes the standard output before Exudyn prints to it)

sys.exudynFast = True

import exudyn as exu  # noqa: E402  (the line above decides which build is loaded)


def settings(steps, end, method="alpha", sparse=False, full_newton=False):
    """`method`: `alpha` (generalised alpha, spectral radius 0.8), `trapezoidal` (index 2) or
    `dopri5` with automatic steps; then `steps` are outputs at least."""
    s = exu.SimulationSettings()
    s.timeIntegration.numberOfSteps = steps
    s.timeIntegration.endTime = end
    s.timeIntegration.verboseMode = 0
    s.solution.file.write = False
    s.solution.sensors.active = False
    s.timeIntegration.adaptiveStep = False
    s.timeIntegration.newton.useModifiedNewton = not full_newton
    s.timeIntegration.newton.relativeTolerance = 1e-8 if full_newton else 1e-10
    s.timeIntegration.newton.absoluteTolerance = 1e-10 if full_newton else 1e-12
    s.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    if sparse:
        s.linearSolverType = exu.LinearSolverType.EigenSparse
        s.linearSolver.reuseAnalyzedPattern = True
    solver = {
        "alpha": exu.DynamicSolverType.GeneralizedAlpha,
        "trapezoidal": exu.DynamicSolverType.TrapezoidalIndex2,
        "dopri5": exu.DynamicSolverType.DOPRI5,
    }[method]
    return s, solver


def solve(mbs, chosen):
    """Runs an assembled system; whether it succeeded."""
    s, solver = chosen
    return mbs.SolveDynamic(s, solverType=solver, showHints=False, updateInitialValues=False)


def system():
    """An empty system with its container, which must live as long."""
    container = exu.SystemContainer()
    return container, container.AddSystem()
