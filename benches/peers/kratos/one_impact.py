"""One ball strikes one triangle in Kratos' DEM application; prints its wear fields as JSON.

Run by ../kratos.py inside an environment that has Kratos: FOLDER ANGLE SPEED DT.
"""

import json
import math
import os
import sys
from pathlib import Path

RADIUS, DENSITY, FRICTION = 0.003, 2500.0, 0.3
CORNERS = {2: (-0.02, -0.02, 0.0), 3: (0.03, -0.02, 0.0), 4: (-0.005, 0.03, 0.0)}
SEVERITY, HARDNESS = 1.0, 1.0
LAW = {
    "COEFFICIENT_OF_RESTITUTION": 1.0,
    "STATIC_FRICTION": FRICTION,
    "DYNAMIC_FRICTION": FRICTION,
    "FRICTION_DECAY": 500,
    "ROLLING_FRICTION": 0.0,
    "ROLLING_FRICTION_WITH_WALLS": 0.0,
    "SEVERITY_OF_WEAR": SEVERITY,
    "IMPACT_WEAR_SEVERITY": SEVERITY,
    "BRINELL_HARDNESS": HARDNESS,
    "DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME": "DEM_D_Hertz_viscous_Coulomb",
    "DEM_ROLLING_FRICTION_MODEL_NAME": "DEMRollingFrictionModelConstantTorque",
}
ELASTIC = {"YOUNG_MODULUS": 2e11, "POISSON_RATIO": 0.3}


def block(kind, lines):
    return f"Begin {kind}\n" + "".join(f"{line}\n" for line in lines) + f"End {kind.split()[0]}\n"


def write_case(folder, angle, speed, dt):
    """Writes ball, plate and materials; returns the parameters of the run."""
    head = block("ModelPartData", [])
    ball = (
        head
        + block("Properties 1", [])
        + block("Nodes", [f"1 0.0 0.0 {RADIUS + 1e-6}"])
        + block("Elements SphericParticle3D", ["1 1 1"])
        + block("NodalData RADIUS", [f"1 0 {RADIUS}"])
        + "Begin SubModelPart Ball\n"
        + block("SubModelPartNodes", ["1"])
        + block("SubModelPartElements", ["1"])
        + "End SubModelPart\n"
    )
    wall = (
        head
        + block("Properties 2", [])
        + block("Nodes", ["%d %g %g %g" % (id, *at) for id, at in CORNERS.items()])
        + block("Conditions RigidFace3D3N", ["1 2 2 3 4"])
        + "Begin SubModelPart Plate\n"
        + block("SubModelPartNodes", CORNERS)
        + block("SubModelPartConditions", ["1"])
        + "End SubModelPart\n"
    )
    pair = lambda other: {
        "material_names_list": ["ball", other],
        "material_ids_list": [1, 1 if other == "ball" else 2],
        "Variables": LAW,
    }
    materials = {
        "materials": [
            {"material_name": "ball", "material_id": 1,
             "Variables": {"PARTICLE_DENSITY": DENSITY, **ELASTIC}},
            {"material_name": "plate", "material_id": 2,
             "Variables": {"COMPUTE_WEAR": True, **ELASTIC}},
        ],
        "material_relations": [pair("ball"), pair("plate")],
        "material_assignation_table": [["SpheresPart", "ball"], ["RigidFacePart", "plate"]],
    }
    duration = 4e-5 + 2e-6 / (speed * math.sin(math.radians(angle)))
    project = {
        "problem_name": "impact",
        "do_print_results_option": False,
        "dem_inlet_option": False,
        "GravityZ": 0.0,
        "MaxTimeStep": dt,
        "FinalTime": duration,
        "NeighbourSearchFrequency": 10,
        "OutputTimeStep": 1.0,
        "GraphExportFreq": 1.0,
        "ElementType": "SphericPartDEMElement3D",
        "TranslationalIntegrationScheme": "Velocity_Verlet",
        "solver_settings": {
            "strategy": "sphere_strategy",
            "RemoveBallsInitiallyTouchingWalls": False,
        },
    }
    (folder / "impactDEM.mdpa").write_text(ball)
    (folder / "impactDEM_FEM_boundary.mdpa").write_text(wall)
    (folder / "MaterialsDEM.json").write_text(json.dumps(materials))
    return json.dumps(project)


def main(folder, angle, speed, dt):
    folder = Path(folder)
    angle, speed, dt = float(angle), float(speed), float(dt)
    project = write_case(folder, angle, speed, dt)
    os.chdir(folder)
    import KratosMultiphysics as kratos
    from KratosMultiphysics import DEMApplication as dem
    from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

    class Impact(DEMAnalysisStage):
        def Initialize(self):
            super().Initialize()
            ball = next(iter(self.spheres_model_part.Nodes))
            radians = math.radians(angle)
            velocity = [speed * math.cos(radians), 0.0, -speed * math.sin(radians)]
            ball.SetSolutionStepValue(kratos.VELOCITY, kratos.Array3(velocity))

        def Finalize(self):
            ball = next(iter(self.spheres_model_part.Nodes))
            plate = list(self.rigid_face_model_part.Nodes)
            total = lambda field: sum(node.GetSolutionStepValue(field) for node in plate)
            self.found = {
                "velocity": list(ball.GetSolutionStepValue(kratos.VELOCITY)),
                "impact_wear": total(dem.IMPACT_WEAR),
                "sliding_wear": total(dem.NON_DIMENSIONAL_VOLUME_WEAR),
                "moved": any(
                    (node.X, node.Y, node.Z) != (node.X0, node.Y0, node.Z0) for node in plate
                ),
            }
            super().Finalize()

    stage = Impact(kratos.Model(), kratos.Parameters(project))
    stage.Run()
    print("FOUND", json.dumps(stage.found))


if __name__ == "__main__":
    main(*sys.argv[1:])
