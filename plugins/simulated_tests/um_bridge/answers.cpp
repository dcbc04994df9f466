// SPDX-License-Identifier: Apache-2.0
#include "answers.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "tunica/detail/bounded_json.hpp"

namespace tunica::um_bridge {

using Json = nlohmann::json;

namespace {

constexpr std::size_t longest_words = 500, most_numbers = 10'000'000;

std::string shown(const Json& value) {
  std::string text =
      value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > longest_words) text = text.substr(0, longest_words) + " …";
  return text;
}

[[noreturn]] void refuse(const std::string& source, const std::string& found, const char* expected) {
  throw std::runtime_error(
      fmt::format("{} answered with {} where {} is expected; correct the server", source, found, expected));
}

const Json& member(const Json& answer, const char* key, const std::string& source) {
  const auto found = answer.find(key);
  if (found == answer.end()) refuse(source, fmt::format("no \"{}\"", key), "one");
  return *found;
}

std::vector<double> numbers_of(const Json& list, const std::string& place, const std::string& source) {
  if (!list.is_array()) refuse(source, fmt::format("{} at {}", list.type_name(), place), "a list of numbers");
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (const Json& one : list) {
    if (!one.is_number())
      refuse(source, fmt::format("{} at {}/{}", shown(one), place, numbers.size()), "a finite number");
    numbers.push_back(one.get<double>());
  }
  return numbers;
}

}  // namespace

Json read_answer(const std::string& source, int status, const std::string& body) {
  Json answer = detail::parse_json(body, false);
  if (answer.is_object() && answer.contains("error")) {
    const Json& error = answer["error"];
    const bool worded = error.is_object() && error.contains("message");
    throw std::runtime_error(fmt::format("{} answered: {}", source, shown(worded ? error["message"] : error)));
  }
  if (detail::excess_of_levels(body) != std::string::npos)
    throw std::runtime_error(
        fmt::format("{} answered with JSON of more than {} levels of nesting; check what listens "
                    "there",
                    source, detail::deepest_json));
  if (status != 200 || !answer.is_object())
    throw std::runtime_error(
        fmt::format("{} answered with status {} and no JSON object: {}", source, status, shown(Json(body))));
  return answer;
}

std::vector<std::size_t> sizes_in(const Json& answer, const char* key, const std::string& source) {
  const Json& list = member(answer, key, source);
  if (!list.is_array()) refuse(source, fmt::format("{} as \"{}\"", list.type_name(), key), "a list of sizes");
  std::vector<std::size_t> sizes;
  std::size_t sum = 0;
  for (const Json& one : list) {
    const bool size = one.is_number_unsigned() && one.get<std::size_t>() <= most_numbers;
    if (!size || (sum += one.get<std::size_t>()) > most_numbers)
      refuse(source, fmt::format("{} at {}/{}", shown(one), key, sizes.size()), "a size of at most ten million in all");
    sizes.push_back(one.get<std::size_t>());
  }
  return sizes;
}

std::vector<std::vector<double>> vectors_in(const Json& answer, const std::string& source) {
  const Json& lists = member(answer, "output", source);
  if (!lists.is_array()) refuse(source, fmt::format("{} as \"output\"", lists.type_name()), "a list of lists");
  std::vector<std::vector<double>> vectors;
  for (const Json& list : lists) vectors.push_back(numbers_of(list, fmt::format("output/{}", vectors.size()), source));
  return vectors;
}

std::vector<double> vector_in(const Json& answer, const std::string& source) {
  return numbers_of(member(answer, "output", source), "output", source);
}

}  // namespace tunica::um_bridge
