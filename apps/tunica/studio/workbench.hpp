// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "session.hpp"

namespace tunica::app::studio {

/// A file has changed since the page read it.
class Overtaken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Experiments that the page has open, with what their runs predict: the core's own functions, called in this process.
/// Tests that start a program or ask a server are not evaluated here. Thread-safe.
class Workbench {
 public:
  explicit Workbench(const Session& session);
  ~Workbench();

  /// The document without its comments, and the file's state: {"document", "text", "hash", "commented"}. Throws
  /// InputError.
  static nlohmann::ordered_json document(const std::string& file);
  /// What is to be written: a text as somebody has typed it, or a document, which has no comments.
  struct Written {
    std::string text;
    bool is_document = false, as_new = false;
  };
  /// Writes over the file where that loses no comments and is nobody's result, else beside it. What the program cannot
  /// read is not written. Returns {"file"}. Throws InputError, and Overtaken where the file to be written over has
  /// another hash than document() gave.
  nlohmann::ordered_json save(const std::string& file, const std::string& hash, const Written& written);
  /// What the program says of a text in the place of the file: {"error": null or words, "line", "column"}, the place
  /// null where the error has none. Starts no program and asks no server. Writes a file beside it, which goes again.
  /// Throws InputError where none can be written there.
  [[nodiscard]] nlohmann::ordered_json proof(const std::string& file, const std::string& text) const;

  /// {"name", "runs": [{"entry": number within "runs" of the file, "label", "model", "optimizer", "parameters": [{name,
  /// unit, min, max, initial, scale}], "fixed", "channels": [{test, observable, unit, over, over_unit, x, y, breaks:
  /// [row at which another curve of a family begins], held_out: number of rows, rows}]}]}. Channels have at most 200
  /// 000 rows, evenly chosen. Throws InputError.
  nlohmann::ordered_json problem(const std::string& file);
  /// What a run predicts at values of its free parameters, in base units, at the rows that problem() gives. Bytes: the
  /// length of what follows (uint32, as the machine has it, like all numbers here), {"rows": [number of each channel],
  /// "objective", "quality": [{rmse, r2, share}], "milliseconds"} or {"failed": reason} as JSON, spaces up to a
  /// multiple of four bytes, then a float for each row of each channel. Where a prediction takes long, the objective is
  /// null, see judge(). `share` is RMSE over the range of the observable. Throws InputError.
  std::string simulate(const std::string& file, const std::string& label, const std::vector<double>& values);
  /// What is asked where the values rest: whether a material is stable there, as `tunica stability` judges, and the
  /// objective: {"stable": true, false or null, "sentences", "objective"}. Throws InputError.
  nlohmann::ordered_json judge(const std::string& file, const std::string& label, const std::vector<double>& values);
  /// As `tunica check --json`. Throws InputError.
  nlohmann::ordered_json check(const std::string& file);

 private:
  struct Open;
  std::shared_ptr<const Open> opened(const std::string& file);

  const Session& session_;
  std::mutex saving_, mutex_;                    ///< one save at a time; what is below
  std::list<std::shared_ptr<const Open>> open_;  ///< the last used first
};

}  // namespace tunica::app::studio
