// SPDX-License-Identifier: Apache-2.0
#include "connection.hpp"

#include <chrono>
#include <future>
#include <stdexcept>

#include <fmt/format.h>
#include <httplib.h>

#include "answers.hpp"
#include "held_socket.hpp"

namespace tunica::um_bridge {

using Json = nlohmann::json;

namespace {

constexpr std::chrono::milliseconds heartbeat{10};
constexpr std::size_t largest_answer = std::size_t{32} << 20U;  ///< bytes, headers included: a million numbers

/// Why an exchange was given up.
enum class GivenUp { no, late, interrupted, large };

}  // namespace

Connection::Connection(std::string url, std::string model, Json config, double seconds,
                       std::function<bool()> interrupted)
    : url_(std::move(url)),
      model_(std::move(model)),
      config_(std::move(config)),
      seconds_(seconds),
      interrupted_(std::move(interrupted)) {}

/// The library limits each wait for bytes, not the whole, and takes headers and bodies of any length: so it works in a
/// thread of its own, and this one watches the connection.
Json Connection::ask(const std::string& path, const Json* request) const {
  const std::string source = url_ + path;
  HeldSocket held;
  httplib::Client client(url_);
  const auto limit = std::chrono::microseconds(static_cast<long long>(seconds_ * 1e6));
  client.set_connection_timeout(limit);
  client.set_read_timeout(limit);
  client.set_write_timeout(limit);
  client.set_decompress(false);
  client.set_socket_options([&held](int socket) { held.hold(socket); });
  const httplib::Headers headers = {{"Accept-Encoding", "identity"}};
  const std::string asked = request == nullptr ? "" : request->dump();
  const auto end = std::chrono::steady_clock::now() + limit;
  auto exchange = std::async(std::launch::async, [&] {
    return request == nullptr ? client.Get(path, headers) : client.Post(path, headers, asked, "application/json");
  });
  GivenUp given_up = GivenUp::no;
  while (exchange.wait_for(heartbeat) != std::future_status::ready) {
    if (given_up == GivenUp::no && held.received() > largest_answer) given_up = GivenUp::large;
    if (given_up == GivenUp::no && std::chrono::steady_clock::now() >= end) given_up = GivenUp::late;
    if (given_up == GivenUp::no && interrupted_ && interrupted_()) given_up = GivenUp::interrupted;
    if (given_up != GivenUp::no) held.end();
  }
  const httplib::Result result = exchange.get();
  if (given_up == GivenUp::large || (result && result->body.size() > largest_answer))
    throw std::runtime_error(
        fmt::format("{} sent more than {} MiB, and no answer may be larger; check what listens there, or let the "
                    "server simulate fewer numbers",
                    source, largest_answer >> 20U));
  if (given_up == GivenUp::interrupted)
    throw std::runtime_error(
        fmt::format("{} was not waited for: the work was interrupted, or its max_time was over", source));
  if (given_up == GivenUp::late || (!result && std::chrono::steady_clock::now() >= end))
    throw std::runtime_error(fmt::format(
        "{} did not answer within {:g} s; start the server anew, or give it more \"time_limit\"", source, seconds_));
  if (!result)
    throw std::runtime_error(
        fmt::format("{} cannot be reached, or broke off ({}); start the server, or correct "
                    "\"url\"",
                    source, httplib::to_string(result.error())));
  if (const std::string encoding = result->get_header_value("Content-Encoding");
      !encoding.empty() && encoding != "identity")
    throw std::runtime_error(
        fmt::format("{} answered in the encoding '{}', which was not asked for; let the server "
                    "send plain JSON",
                    source, encoding.substr(0, 40)));
  return read_answer(source, result->status, result->body);
}

Json Connection::request() const { return {{"name", model_}, {"config", config_}}; }

void Connection::greet() const {
  const Json info = ask("/Info", nullptr);
  const auto version = info.find("protocolVersion");
  if (version == info.end() || *version != 1.0)
    throw std::runtime_error(fmt::format("{} speaks version {} of UM-Bridge; expected 1.0", url_,
                                         version != info.end() && version->is_number() ? version->dump() : "unknown"));
  std::string names;
  for (const Json& name : info.value("models", Json::array())) {
    if (name == model_) return;
    if (name.is_string() && names.size() < 500) names += (names.empty() ? "" : ", ") + name.get<std::string>();
  }
  throw std::runtime_error(fmt::format("{} has no model '{}'; it has {}", url_, model_, names));
}

std::vector<std::size_t> Connection::input_sizes() const {
  const Json request = this->request();
  return sizes_in(ask("/InputSizes", &request), "inputSizes", source("/InputSizes"));
}

std::vector<std::size_t> Connection::output_sizes() const {
  const Json request = this->request();
  return sizes_in(ask("/OutputSizes", &request), "outputSizes", source("/OutputSizes"));
}

bool Connection::supports(const char* feature) const {
  const Json request = this->request();
  const Json info = ask("/ModelInfo", &request), support = info.value("support", Json::object());
  return support.is_object() && support.value(feature, Json()) == true;
}

Connection::Vectors Connection::evaluate(const Vectors& input) const {
  Json request = this->request();
  request["input"] = input;
  return vectors_in(ask("/Evaluate", &request), source("/Evaluate"));
}

std::vector<double> Connection::apply_jacobian(std::size_t output, std::size_t input, const Vectors& at,
                                               const std::vector<double>& vector) const {
  Json request = this->request();
  request.update({{"outWrt", output}, {"inWrt", input}, {"input", at}, {"vec", vector}});
  return vector_in(ask("/ApplyJacobian", &request), source("/ApplyJacobian"));
}

}  // namespace tunica::um_bridge
