// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "data/written_file.hpp"

namespace tunica::testing {

/// The experiment file of the design, one key a line so that tests can name lines, with its data files.
inline const char* const design_example = R"({
  "$schema": "tunica-experiment.schema.json",
  "format": 1, "name": "lamb-aorta", "seed": 7,
  "models": {
    "gho": {
      "type": "gho",
      "parameters": {
        "mu": {"min": "0.5 kPa", "max": "200 kPa", "scale": "log"},
        "kappa": {"min": 0, "max": 0.3333}
      },
      "mechanisms": [ {"type": "viscoelasticity"} ]
    }
  },
  "tests": {
    "circumferential_strip": {
      "type": "uniaxial",
      "direction": "circumferential",
      "data": {
        "file": "circ.csv",
        "columns": {"stretch": "stretch", "stress": "stress"},
        "stress_measure": "cauchy",
        "rows": "0:240:6",
        "noise": {"relative": 0.02}
      },
      "weight": 1,
      "hold_out": false
    },
    "inflation": {
      "type": "thick_wall_pressurisation",
      "inner_radius": "3.71 mm", "thickness": "2.06 mm", "axial_stretch": 1.2,
      "data": {
        "file": "inflation.csv",
        "columns": {"pressure": "pressure", "outer_diameter_stretch": "outer_diameter_stretch", "axial_force": "axial_force"}
      }
    }
  },
  "objective": {"type": "standardised_quadratic"},
  "constraints": [ {"type": "transverse_stability", "h": 0.7} ], // the paper's
  "optimizers": {
    "es": {"type": "es", "parents": 30, "offspring": 120, "selection": "plus"},
    "lm": {"type": "ceres_lm", "starts": 20},
    "hybrid": {"stages": ["es", "lm"]}
  },
  "stop": {"max_evaluations": 60000, "max_time": "10 min", "target": 1e-6, "stall": 500},
  "runs": [
    {"model": "gho", "optimizer": "es", "realisations": 100},
    {"model": "gho", "optimizer": "lm"}
  ],
  "on_failure": "penalise",
  "diagnosis": {"model": "gho", "optimizer": "lm", "alpha": 0.05, "mechanisms": "all"}
}
)";

inline const char* const circ_csv = "stretch [-],stress [kPa]\n1,0\n1.1,6.6\n1.2,14.9\n";
inline const char* const inflation_csv =
    "pressure [mmHg],outer_diameter_stretch [-],axial_force [mN]\n0,0.898,714.7\n80,1.14,824.7\n";

}  // namespace tunica::testing
