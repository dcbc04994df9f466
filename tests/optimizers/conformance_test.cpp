// SPDX-License-Identifier: Apache-2.0
#include "optimizers/conformance.hpp"

namespace tunica::testing {

TUNICA_OPTIMIZER_CONFORMANCE(
    Es, Subject{.label = "plus", .type = "es"},
    Subject{.label = "comma", .type = "es", .options = {{"selection", "comma"}}},
    Subject{.label = "isotropic",
            .type = "es",
            .options = {{"adaptation", "isotropic"},
                        {"parents", std::int64_t{30}},
                        {"offspring", std::int64_t{120}},
                        {"restart_growth", 1.0}},
            .abilities = {.oblique = false}},
    Subject{.label = "self_adaptive", .type = "es", .options = {{"step_control", "self_adaptive"}}},
    Subject{.label = "constant_penalty", .type = "es", .options = {{"infeasible", "constant_penalty"}}},
    Subject{.label = "axes_discrete",
            .type = "es",
            .options = {{"adaptation", "axes"}, {"recombination", "discrete"}, {"selection", "comma"}},
            .abilities = {.oblique = false}},
    Subject{.label = "resample_intermediate",
            .type = "es",
            .options = {{"bounds", "resample"}, {"recombination", "intermediate"}}},
    Subject{.label = "clamp_one_parent",
            .type = "es",
            .options = {{"bounds", "clamp"}, {"recombination", "none"}, {"restart_growth", 2.0}}});

TUNICA_OPTIMIZER_CONFORMANCE(CmaEs, Subject{.label = "by_dimension", .type = "cma_es"},
                             Subject{.label = "two_points",
                                     .type = "cma_es",
                                     .options = {{"population", std::int64_t{2}}}});

TUNICA_OPTIMIZER_CONFORMANCE(
    CeresLm, Subject{.label = "latin_hypercube", .type = "ceres_lm", .budget = 3000, .abilities = {.infeasible = true}},
    Subject{.label = "sobol",
            .type = "ceres_lm",
            .options = {{"sampling", "sobol"}},
            .budget = 3000,
            .abilities = {.infeasible = true}},
    Subject{.label = "screened",
            .type = "ceres_lm",
            .options = {{"screening_iterations", std::int64_t{6}}},
            .budget = 3000,
            .abilities = {.infeasible = true}});

TUNICA_OPTIMIZER_CONFORMANCE(Nlopt, Subject{.label = "crs2_lm", .type = "nlopt"},
                             Subject{.label = "isres",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "isres"}},
                                     .abilities = {.oblique = false, .infeasible = true}},
                             Subject{.label = "direct_l",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "direct_l"}},
                                     .abilities = {.oblique = false, .random = false, .infeasible = true},
                                     .boundary = 1e-2},
                             Subject{.label = "mlsl_slsqp",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "mlsl"}},
                                     .abilities = {.random = false, .infeasible = true}},
                             Subject{.label = "mlsl_bobyqa",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "mlsl"}, {"local_algorithm", "bobyqa"}},
                                     .abilities = {.oblique = false, .random = false, .infeasible = true}},
                             Subject{.label = "cobyla",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "cobyla"}, {"step_tolerance", 1e-6}},
                                     .abilities = {.oblique = false, .infeasible = true}},
                             Subject{.label = "bobyqa",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "bobyqa"}},
                                     .abilities = {.infeasible = true}},
                             Subject{.label = "slsqp",
                                     .type = "nlopt",
                                     .options = {{"algorithm", "slsqp"}},
                                     .budget = 5000,
                                     .abilities = {.infeasible = true}});

#ifdef TUNICA_HAVE_PAGMO
TUNICA_OPTIMIZER_CONFORMANCE(Pagmo, Subject{.label = "de1220", .type = "pagmo_de"},
                             Subject{.label = "sade", .type = "pagmo_de", .options = {{"variant", "sade"}}},
                             Subject{.label = "pso", .type = "pagmo_pso", .abilities = {.oblique = false}},
                             Subject{
                                 .label = "ga", .type = "pagmo_ga", .abilities = {.oblique = false}, .boundary = 1e-2},
                             Subject{.label = "cmaes", .type = "pagmo_cmaes"});
#endif

#ifdef TUNICA_HAVE_PAGMO
TEST(Pagmo, RefusesPopulationsThatItsAlgorithmsCannotWorkWith) {
  for (const auto& [type, least] : {std::pair{"pagmo_de", 7}, {"pagmo_cmaes", 5}, {"pagmo_ga", 2}, {"pagmo_pso", 2}}) {
    const auto with = [&, name = type](std::int64_t population) {
      const auto optimizer = make_optimizer(name, {{"population", population}, {"restarts", std::int64_t{0}}});
      FunctionProblem problem(sphere(2), {.budget = 100});
      optimizer->minimise(problem);
      return problem.evaluations();
    };
    EXPECT_EQ(with(least), 100u) << type;
    try {
      static_cast<void>(with(least - 1));
      ADD_FAILURE() << type << " takes a population of " << least - 1;
    } catch (const InputError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("is too small, " + std::to_string(least) + " is the least"),
                std::string::npos)
          << refusal.what();
    }
  }
}
#endif

}  // namespace tunica::testing
