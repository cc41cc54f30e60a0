"""All mutations, room by room."""

from . import (
    adaptive,
    app,
    fem,
    forms,
    march,
    mesh,
    model,
    multigrid,
    output,
    parallel,
    plan,
    refinement,
    scene,
    solve,
    theory,
)
from .mutation import Mutation

MUTATIONS: tuple[Mutation, ...] = (
    *forms.SIGNS,
    *forms.OTHERS,
    *scene.MUTATIONS,
    *mesh.MUTATIONS,
    *fem.MUTATIONS,
    *model.MUTATIONS,
    *solve.MUTATIONS,
    *multigrid.MUTATIONS,
    *march.MUTATIONS,
    *adaptive.MUTATIONS,
    *refinement.MUTATIONS,
    *output.MUTATIONS,
    *theory.MUTATIONS,
    *parallel.MUTATIONS,
    *plan.MUTATIONS,
    *app.MUTATIONS,
)
