// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnosis.hpp"

#include <utility>

#include "diagnosis/evidence/gross_rows.hpp"
#include "diagnosis/file/weighing.hpp"
#include "diagnosis/naming/gross_causes.hpp"
#include "diagnosis/naming/intervals.hpp"

namespace tunica::diagnosis {
namespace {

/// An analysis, and its gross rows if nothing else is wrong.
struct Screening {
  Analysis analysis;
  std::vector<GrossRow> gross;
};

/// Gross rows are left out if something else is wrong too, because they would disturb its analysis.
Screening screen(const Inquiry& inquiry) {
  Analysis whole = analyse(inquiry, {});
  std::vector<GrossRow> gross;
  if (whole.alarm.raised) gross = gross_rows(whole.evidence);
  if (gross.empty()) return {std::move(whole), {}};
  Analysis others = analyse(inquiry, gross);
  if (others.alarm.raised) return {std::move(others), {}};
  return {std::move(whole), std::move(gross)};
}

struct Explained {
  Analysis analysis;
  Explanation explanation;
};

/// Noise estimated from the residuals of the base is estimated once more from those of the extension.
Explained with_noise_of_extension(const Inquiry& inquiry, Explained found) {
  if (!found.explanation.claim.best || !found.explanation.gross.empty()) return found;
  auto analysis = restated(inquiry, found.analysis, found.explanation.claim.best->fit);
  if (!analysis) return found;
  Explanation explanation = explain(inquiry, *analysis, {});
  return {std::move(*analysis), std::move(explanation)};
}

/// Rows that the causes explain were not gross errors. They are restored, and the analysis is repeated.
Explained explained(const Inquiry& inquiry) {
  Screening screening = screen(inquiry);
  Explanation explanation = explain(inquiry, screening.analysis, screening.gross);
  const std::vector<GrossRow> gross = still_gross(screening.analysis, explanation.claim);
  if (gross.size() == screening.analysis.evidence.gross.size())
    return with_noise_of_extension(inquiry, {std::move(screening.analysis), std::move(explanation)});
  Analysis analysis = analyse(inquiry, gross);
  explanation = explain(inquiry, analysis, {});
  return with_noise_of_extension(inquiry, {std::move(analysis), std::move(explanation)});
}

}  // namespace

std::vector<Warning> Diagnosis::warnings() const {
  std::vector<Warning> all = analysis.evidence.warnings;
  const std::vector<Warning>& noise = analysis.evidence.noise_warnings;
  all.insert(all.end(), noise.begin(), noise.end());
  all.insert(all.end(), prospects.warnings.begin(), prospects.warnings.end());
  return all;
}

Diagnosis diagnose(const experiment::Experiment& experiment, const Request& request,
                   const plugins::Catalogue& catalogue, const Progress& progress) {
  const experiment::Experiment measured = experiment::measured_only(experiment);
  const Inquiry inquiry{measured, request, catalogue, progress};
  Explained found = explained(inquiry);
  found.explanation = weighed_with_file(inquiry, found.analysis, std::move(found.explanation));
  Explanation explanation = with_refitted_intervals(inquiry, found.analysis, std::move(found.explanation));
  Prospects prospects = prospects_of(inquiry, found.analysis, explanation);
  inquiry.report("done", 1);
  return {request, std::move(found.analysis), std::move(explanation), std::move(prospects)};
}

}  // namespace tunica::diagnosis
