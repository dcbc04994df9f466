// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// What a server of UM-Bridge may answer. Its texts come from anywhere: each function throws std::runtime_error that
/// says what was found, and no other exception.
namespace tunica::um_bridge {

/// The JSON of an answer, with the server's own words where it tells of an error. `source` names who was asked what.
nlohmann::json read_answer(const std::string& source, int status, const std::string& body);
/// The member `key`: sizes of vectors, at most ten million numbers in all.
std::vector<std::size_t> sizes_in(const nlohmann::json& answer, const char* key, const std::string& source);
/// The member "output": a list of lists of numbers, or a list of numbers.
std::vector<std::vector<double>> vectors_in(const nlohmann::json& answer, const std::string& source);
std::vector<double> vector_in(const nlohmann::json& answer, const std::string& source);

}  // namespace tunica::um_bridge
