// SPDX-License-Identifier: Apache-2.0
#include "connection.hpp"

#include <chrono>
#include <stdexcept>

#include <fmt/format.h>
#include <httplib.h>

namespace tunica::um_bridge {

using Json = nlohmann::json;

Connection::Connection(std::string url, std::string model, Json config, double seconds)
    : url_(std::move(url)), model_(std::move(model)), config_(std::move(config)), seconds_(seconds) {}

Json Connection::ask(const std::string& path, const Json* request) const {
  httplib::Client client(url_);
  const auto limit = std::chrono::microseconds(static_cast<long long>(seconds_ * 1e6));
  client.set_connection_timeout(limit);
  client.set_read_timeout(limit);
  client.set_write_timeout(limit);
  const auto begun = std::chrono::steady_clock::now();
  const httplib::Result result =
      request == nullptr ? client.Get(path) : client.Post(path, request->dump(), "application/json");
  if (!result && std::chrono::steady_clock::now() - begun >= limit)
    throw std::runtime_error(
        fmt::format("{}{} did not answer within {:g} s; start the server anew, or give it more "
                    "\"time_limit\"",
                    url_, path, seconds_));
  if (!result)
    throw std::runtime_error(
        fmt::format("{}{} cannot be reached, or broke off ({}); start the server, or correct \"url\"", url_, path,
                    httplib::to_string(result.error())));
  Json answer = Json::parse(result->body, nullptr, false);
  if (answer.is_object() && answer.contains("error")) {
    const Json& error = answer["error"];
    throw std::runtime_error(fmt::format("{}{} answered: {}", url_, path,
                                         error.is_object() ? error.value("message", error.dump()) : error.dump()));
  }
  if (result->status != 200 || answer.is_discarded())
    throw std::runtime_error(fmt::format("{}{} answered with status {} and no JSON: {}", url_, path, result->status,
                                         result->body.substr(0, 200)));
  return answer;
}

Json Connection::request() const { return {{"name", model_}, {"config", config_}}; }

void Connection::greet() const {
  const Json info = ask("/Info", nullptr);
  const double version = info.value("protocolVersion", 0.0);
  if (version != 1.0)
    throw std::runtime_error(fmt::format("{} speaks version {:g} of UM-Bridge; expected 1.0", url_, version));
  const auto models = info.value("models", std::vector<std::string>{});
  std::string names;
  for (const std::string& name : models) {
    if (name == model_) return;
    names += (names.empty() ? "" : ", ") + name;
  }
  throw std::runtime_error(fmt::format("{} has no model '{}'; it has {}", url_, model_, names));
}

std::vector<std::size_t> Connection::input_sizes() const {
  const Json request = this->request();
  return ask("/InputSizes", &request).at("inputSizes").get<std::vector<std::size_t>>();
}

std::vector<std::size_t> Connection::output_sizes() const {
  const Json request = this->request();
  return ask("/OutputSizes", &request).at("outputSizes").get<std::vector<std::size_t>>();
}

bool Connection::supports(const char* feature) const {
  const Json request = this->request();
  return ask("/ModelInfo", &request).at("support").value(feature, false);
}

Connection::Vectors Connection::evaluate(const Vectors& input) const {
  Json request = this->request();
  request["input"] = input;
  return ask("/Evaluate", &request).at("output").get<Vectors>();
}

std::vector<double> Connection::apply_jacobian(std::size_t output, std::size_t input, const Vectors& at,
                                               const std::vector<double>& vector) const {
  Json request = this->request();
  request.update({{"outWrt", output}, {"inWrt", input}, {"input", at}, {"vec", vector}});
  return ask("/ApplyJacobian", &request).at("output").get<std::vector<double>>();
}

}  // namespace tunica::um_bridge
