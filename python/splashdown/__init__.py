"""Light bodies landing on water: scenes are run, checked, priced and studied by the command, or stepped by hand.

    import splashdown
    result = splashdown.run("examples/wedge_drop/scene.toml", refine=0.5)
    print(result.grade, result.summary["bodies"]["wedge"]["peak_force"]["value"])
    t, fy = result.table("bodies")["time"], result.table("bodies")["fy"]

    for now in splashdown.Simulation.open("scene.toml"):
        print(now.time, now.bodies["wedge"].force[1])

    afloat = splashdown.hydrostatics("hull.stl", mass=12)
    print(afloat.draft, afloat.gm_roll, afloat.levers.max())

SI units; in two dimensions masses and loads are per metre of depth. Keys of scenes: docs/scene.md; files of runs: docs/files.md.
"""
from ._command import CommandError, check, price, run, study, version
from ._results import Result, StudyResult
from ._simulation import Afloat, Body, CannotGoOn, SceneError, Simulation, hydrostatics
from ._toml import scene_text

__all__ = ["Afloat", "Body", "CannotGoOn", "CommandError", "Result", "SceneError", "Simulation", "StudyResult", "check", "hydrostatics", "price", "run",
           "scene_text", "study", "version"]
