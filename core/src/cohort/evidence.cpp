// SPDX-License-Identifier: Apache-2.0
#include "cohort/evidence.hpp"

#include <fstream>
#include <new>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include "cohort_diagnosis/evidence_json.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "execution/checksum.hpp"
#include "execution/files.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* evidence_file = "evidence.json";

std::string inputs_of(const Specification& cohort, const Record& record) {
  return record.inputs + (cohort.diagnosis->quick ? " quick" : " full");
}

/// The file has two lines: who it is of, with the checksum of the second; and what was found.
struct Stored {
  Json head;
  std::string found;
};

/// None where the file is not, to its last digit, one that this version has written.
std::optional<Stored> stored_evidence(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Stored stored;
  std::string line;
  std::getline(stream, line);
  std::getline(stream, stored.found);
  stored.head = detail::parse_json<Json>(line, false);
  if (!execution::intact(stored.head) || stored.head.value("found", "") != execution::checksum(stored.found)) return {};
  return stored;
}

Json what_is_found(const Specification& cohort, const Template& pattern, const Specimen& specimen,
                   const plugins::Catalogue& catalogue) {
  const Bound bound = bind(cohort, pattern, specimen, catalogue);
  diagnosis::Request request = diagnosis::request_of(bound.experiment);
  request.quick = cohort.diagnosis->quick;
  return {{"evidence", cohort_diagnosis::to_json(
                           cohort_diagnosis::evidence_of(specimen.id, bound.experiment, request, catalogue))}};
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw InputError(
      fmt::format("{}: this is no evidence of a specimen, or a part of it. Remove the file, and run the cohort again, "
                  "which makes it anew",
                  file.string()));
}

}  // namespace

bool lacks_evidence(const Specification& cohort, const Specimen& specimen, const Record& record,
                    const std::filesystem::path& results) {
  if (!cohort.diagnosis || record.outcome == Outcome::unreadable) return false;
  const auto stored = stored_evidence(folder_of(results, specimen) / evidence_file);
  return !stored || stored->head.value("inputs", "") != inputs_of(cohort, record);
}

void gather_evidence(const Specification& cohort, const Template& pattern, const Specimen& specimen,
                     const Record& record, const plugins::Catalogue& catalogue, const FitSettings& settings) {
  if (!lacks_evidence(cohort, specimen, record, settings.results)) return;
  const auto file = folder_of(settings.results, specimen) / evidence_file;
  if (settings.noticed && std::filesystem::exists(file) && !stored_evidence(file))
    settings.noticed(
        fmt::format("{}: its checksum does not fit, or another version wrote it; it is made again", file.string()));
  Json found;
  try {
    found = what_is_found(cohort, pattern, specimen, catalogue);
  } catch (const execution::WriteFailure&) {
    throw;
  } catch (const std::bad_alloc&) {  // says nothing of the specimen
    throw;
  } catch (const std::exception& reason) {  // InputError, BaseFitFailure, and what plugins throw
    found = {{"problem", reason.what()}};
  }
  const std::string line = found.dump();
  const Json head = execution::sealed<Json>({{"format", 2},
                                             {"id", specimen.id},
                                             {"inputs", inputs_of(cohort, record)},
                                             {"found", execution::checksum(line)}});
  execution::write_atomically(file, head.dump() + "\n" + line + "\n");
}

CollectedEvidence collect_evidence(const SpecimenTable& table, const Collection& found,
                                   const std::filesystem::path& results) {
  std::vector<std::optional<cohort_diagnosis::SpecimenEvidence>> all(table.specimens.size());
  std::vector<std::string> problems(table.specimens.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    const Record& record = found.records[k];
    if (record.outcome == Outcome::unreadable) {
      problems[k] = record.reason;
      return;
    }
    const auto file = folder_of(results, table.specimens[k]) / evidence_file;
    const auto stored = stored_evidence(file);
    if (!stored) refuse(file);
    const Json json = detail::parse_json<Json>(stored->found, false);
    if (const auto problem = json.find("problem"); problem != json.end() && problem->is_string())
      problems[k] = *problem;
    else if (const auto evidence = json.find("evidence"); evidence != json.end())
      all[k] = cohort_diagnosis::evidence_from_json(*evidence, file.string());
    else
      refuse(file);
  });
  CollectedEvidence collected;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k]) {
      collected.specimens.push_back(std::move(*all[k]));
      collected.positions.push_back(k);
    } else {
      collected.problems.push_back({k, problems[k], found.records[k].outcome == Outcome::unreadable});
    }
  return collected;
}

}  // namespace tunica::cohort
