"""All mutations, room by room."""

from . import (
    adaptive,
    app,
    embed,
    fem,
    forms,
    march,
    mesh,
    model,
    multigrid,
    output,
    parallel,
    plan,
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
    *output.MUTATIONS,
    *theory.MUTATIONS,
    *parallel.MUTATIONS,
    *plan.MUTATIONS,
    *app.MUTATIONS,
    *embed.MUTATIONS,
)
