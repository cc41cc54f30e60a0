"""summary.json: the resolved scene, what was modelled, the final numbers and what the run took."""

import json
import resource
from pathlib import Path
from typing import Any

import dolfinx
from mpi4py import MPI

from oracle_parts.results import History, Stopwatch
from oracle_parts.scene import Scene


def physics(scene: Scene) -> list[str]:
    """The names of the physics in play, in the interface's order."""
    material, heat, sides = scene.material, scene.heat, scene.boundaries.values()
    contacts = scene.contacts.values()
    present = {
        "inertia": material and material.density is not None,
        "elasticity": material and material.elasticity,
        "viscosity": material and material.viscosity,
        "thermal_stress": heat and heat.thermal_stress is not None,
        "body_force": scene.body_force,
        "traction": any(side.traction for side in sides),
        "spring": any(side.spring for side in sides),
        "compliance": any(contact.compliance for contact in contacts),
        "friction": any(contact.friction for contact in contacts),
        "moving_foundation": any(contact.foundation_velocity for contact in contacts),
        "heat_capacity": heat and heat.capacity is not None,
        "conduction": heat and heat.conductivity is not None,
        "strain_heating": heat and heat.strain_heating is not None,
        "strain_rate_heating": heat and heat.strain_rate_heating is not None,
        "heat_source": heat and heat.source,
        "heat_flux": any(side.heat_flux for side in sides),
        "convection": any(side.convection for side in sides),
        "conductance": any(contact.conductance for contact in contacts),
        "friction_heat": any(contact.friction and contact.friction.heat_share > 0.0 for contact in contacts),
    }
    return [name for name, here in present.items() if here]


def summary(
    scene: Scene,
    mesh: Any,
    unknowns: dict[str, int],
    status: str,
    history: History,
    watch: Stopwatch,
    solver: str,
) -> dict[str, Any]:
    final: dict[str, Any] = {}
    contact: dict[str, dict[str, float]] = {name: {} for name in scene.contacts}
    for name, value in history.last.items():
        if name.startswith("contact."):
            _, side, measure = name.split(".")
            contact[side][measure] = value
        else:
            final[name] = value
    return {
        "status": status,
        "version": f"oracle, dolfinx {dolfinx.__version__}",
        "scene": scene.resolved,
        "physics": physics(scene),
        "mesh": {
            "cells": mesh.topology.index_map(mesh.topology.dim).size_global,
            "vertices": mesh.topology.index_map(0).size_global,
            "unknowns": {"displacement": 0, "temperature": 0, **unknowns},
        },
        "solver": {
            "strategy": "newton-mumps" if solver == "direct" else "newton-gamg",
            "why": f"--solver {solver}",
            "processes": mesh.comm.size,
        },
        "final": {**final, "contact": contact},
        "newton": {
            "iterations": sum(history.iterations),
            "max_iterations_in_a_step": max(history.iterations, default=0),
            "retries": 0,
        },
        "audit": None,
        "seconds": watch.totals(),
    }


def write_summary(directory: Path, comm: Any, content: dict[str, Any]) -> None:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    content["peak_memory_mib"] = comm.allreduce(peak, op=MPI.SUM)
    if comm.rank == 0:
        text = json.dumps(content, indent=2)
        (directory / "summary.json").write_text(text + "\n", encoding="utf-8")
