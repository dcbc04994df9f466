// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/folder.hpp"
#include "report/page.hpp"
#include "report/pieces.hpp"

/// The sections of a report. Each omits what the folder lacks.
namespace tunica::report {

void add_warnings(Page& page, const Folder& folder);
void add_provenance(Page& page, const Folder& folder);

void add_run(Page& page, const Folder& folder);
void add_summary(Page& page, const Folder& folder, const Order& order);
void add_ranking(Page& page, const Folder& folder, const Order& order);
void add_fits(Page& page, const Folder& folder, const Order& order);
/// Of runs and of simulations.
void add_walls(Page& page, const Folder& folder);
/// Maps of a test whose rows are points of a measured field; false where the table is none.
bool add_field(Page& page, const Folder& folder, const Order& order, const Table& table, const std::string& test);
void add_searches(Page& page, const Folder& folder, const Order& order);
void add_parameters(Page& page, const Folder& folder, const Order& order);
/// Relaxation times and stiffnesses of Prony series.
void add_spectra(Page& page, const Folder& folder, const Order& order);
/// Histograms and pairs of the draws from the posterior.
void add_posterior(Page& page, const Folder& folder, const Order& order);
void add_stability(Page& page, const Folder& folder, const Order& order);

void add_diagnosis(Page& page, const Folder& folder);
void add_verdict(Page& page, const Folder& folder);
void add_misfit(Page& page, const Folder& folder);
void add_candidates(Page& page, const Folder& folder);
void add_extension(Page& page, const Folder& folder);
void add_reach(Page& page, const Folder& folder);

/// A folder of `tunica discover`.
void add_discovery(Page& page, const Folder& folder);
/// The results of a discovery: the terms with their curves, rival forms, gain. Empty without a search.
void add_terms(Page& page, const Folder& folder);

void add_simulation(Page& page, const Folder& folder);

void add_cohort(Page& page, const Folder& folder);
/// The errors of the model in all specimens: verdict, picture mechanism × specimen, rivals, contradictions.
void add_cohort_diagnosis(Page& page, const Folder& folder);
void add_bands(Page& page, const Folder& folder);
/// Estimates of every specimen by group, of each parameter and reading.
void add_specimen_estimates(Page& page, const Folder& folder);
/// Data and fit of every specimen, drawn when someone opens the fold.
void add_specimen_fits(Page& page, const Folder& folder);

/// Several folders compared, before each one separately.
void add_comparison(Page& page, const std::vector<Folder>& folders);

}  // namespace tunica::report
