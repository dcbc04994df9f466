// SPDX-License-Identifier: Apache-2.0
#include "studio/desk.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "comparison/provenance.hpp"
#include "execution/files.hpp"
#include "plugins/description.hpp"
#include "plugins/guarded.hpp"
#include "studio/page_files.hpp"
#include "studio/project_folder.hpp"
#include "studio/rig_files.hpp"
#include "text/escaped.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

using json = nlohmann::ordered_json;

namespace {

constexpr const char* page_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; base-uri "
    "'none'; "
    "form-action 'none'; frame-ancestors 'none'";
/// A report has two scripts, which its own policy names by their hashes.
constexpr const char* file_policy =
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

WebReply json_reply(int status, const json& document) {
  return {status, "application/json", text::plain_json(document.dump(-1, ' ', false, json::error_handler_t::replace)),
          guarded_headers("default-src 'none'")};
}

WebReply problem(int status, const std::string& words) { return json_reply(status, {{"error", text::message(words)}}); }

struct Type {
  const char *ending, *type;
};
constexpr std::array types{Type{".html", "text/html; charset=utf-8"}, Type{".json", "application/json"},
                           Type{".csv", "text/plain; charset=utf-8"}, Type{".txt", "text/plain; charset=utf-8"},
                           Type{".log", "text/plain; charset=utf-8"}};

/// Shown in the page as text, or saved by the browser.
std::string type_of(const std::filesystem::path& file) {
  const auto found =
      std::find_if(types.begin(), types.end(), [&](const Type& one) { return file.extension() == one.ending; });
  return found == types.end() ? "application/octet-stream" : found->type;
}

/// The "text" of a question, or its "document".
Workbench::Written written(const std::string& body) {
  const auto question = detail::parse_json<json>(body);
  const bool as_new = question.value("as_new", false);
  if (question.contains("text")) return {question["text"].get<std::string>(), false, as_new};
  return {question.at("document").dump(2) + '\n', true, as_new};
}

json save_upload(const std::string& wished, const std::string& bytes) {
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty; choose another one", text::excerpt(wished)));
  const FreeName name(inside(file_name(wished)));
  execution::write_atomically(name.file, bytes);
  return {{"file", name.file.generic_string()}};
}

}  // namespace

std::optional<WebReply> Desk::refused_body(const WebRequest& request) {
  if (request.method != "POST") return std::nullopt;
  std::size_t length = 0;
  const char* end = request.length.data() + request.length.size();
  const auto [stop, error] = std::from_chars(request.length.data(), end, length);
  if (request.length.empty() || stop != end || error != std::errc())
    return refusal(request, 411, "the request does not say how long it is, in the header Content-Length");
  if (!request.encoding.empty()) return refusal(request, 415, "a compressed body is not read; send it as it is");
  const std::size_t most = request.path == "/api/upload" ? largest_upload : largest_question;
  if (length <= most) return std::nullopt;
  return refusal(request, 413,
                 fmt::format("the request has {} bytes, and at most {} are taken; copy a larger file into the project "
                             "folder",
                             length, most));
}

WebReply Desk::page(const std::string& name) const {
  for (const PageFile& file : page_files())
    if (file.name == name) return {200, std::string(file.type), std::string(file.text), guarded_headers(page_policy)};
  return problem(404, fmt::format("there is no '{}'; load the page again", text::excerpt(name)));
}

WebReply Desk::shown(const std::string& name) const {
  const auto file = file_inside(name);
  return {200, type_of(file), execution::read_text(file), guarded_headers(file_policy)};
}

json Desk::project() {
  json all = contents();
  all["folder"] = std::filesystem::current_path().filename().string();
  all["path"] = std::filesystem::current_path().string();
  all["version"] = comparison::version();
  all["view"] = door_.view();
  all["examples"] = examples();
  all["jobs"] = jobs_.all();
  return all;
}

json Desk::catalogue() const {
  json all = {{"models", json::array()}, {"optimizers", json::array()}, {"tests", json::array()}};
  for (const auto& [name, entry] : session_.catalogue().models())
    all["models"].push_back(plugins::description_json(entry));
  for (const auto& [name, entry] : session_.catalogue().optimizers())
    all["optimizers"].push_back(plugins::description_json(entry));
  for (const auto& [name, entry] : session_.catalogue().tests())
    all["tests"].push_back({{"name", name}, {"doc", entry.factory.doc}});
  return all;
}

WebReply Desk::simulated(const std::string& body) {
  const auto question = detail::parse_json(body);
  return {200, "application/octet-stream",
          workbench_.simulate(question.at("file"), question.at("run"), question.at("values")),
          guarded_headers("default-src 'none'")};
}

json Desk::asked(const WebRequest& request) {
  const std::string& path = request.path;
  if (path == "/api/upload") return save_upload(request.name, request.body);
  const auto question = detail::parse_json(request.body);
  const auto text = [&](const char* key) { return question.at(key).get<std::string>(); };
  if (path == "/api/project") return project();
  if (path == "/api/catalogue") return catalogue();
  if (path == "/api/example") return {{"file", open_example(text("name"))}};
  if (path == "/api/example_curves") return example_curves(text("name"), session_.catalogue());
  if (path == "/api/look") return look_at_rig_files(question, session_.catalogue());
  if (path == "/api/import") return import_rig_files(question, session_.catalogue());
  if (path == "/api/document") return Workbench::document(text("file"));
  if (path == "/api/save")
    return workbench_.save(text("file"), question.value("hash", std::string()), written(request.body));
  if (path == "/api/proof") return workbench_.proof(text("file"), text("text"));
  if (path == "/api/problem") return workbench_.problem(text("file"));
  if (path == "/api/check") return workbench_.check(text("file"));
  if (path == "/api/judge") return workbench_.judge(text("file"), text("run"), question.at("values"));
  if (path == "/api/start") return jobs_.start(question);
  if (path == "/api/stop") {
    jobs_.stop(text("id"));
    return json::object();
  }
  throw InputError(fmt::format("nobody answers '{}'; load the page again", text::excerpt(path)));
}

WebReply Desk::operator()(const WebRequest& request) {
  try {
    if (request.method == "GET" && request.path.starts_with(door_.view()))
      return shown(request.path.substr(door_.view().size()));
    if (request.method == "GET" && request.path == "/") return page("index.html");
    if (request.method == "GET" && request.path.starts_with("/page/")) return page(request.path.substr(6));
    if (request.method == "GET" && request.path == "/api/events") {
      WebReply reply{200, "text/event-stream", {}, guarded_headers("default-src 'none'")};
      reply.events = jobs_.events(request.name);
      return reply;
    }
    if (request.method == "GET" && request.path == "/api/live" && !request.key.empty()) {
      WebReply reply{400, "text/plain; charset=utf-8", {}, {}};
      reply.live = [this](std::string question) {
        WebRequest one;
        one.method = "POST";
        one.path = "/api/simulate";
        one.body = std::move(question);
        return (*this)(one);
      };
      return reply;
    }
    if (request.method != "POST") return problem(404, "there is no such page; open the address that was printed");
    if (request.path == "/api/schema")
      return {200, "application/json", experiment::compose_schema(session_.catalogue()),
              guarded_headers("default-src 'none'")};
    if (request.path == "/api/simulate") return simulated(request.body);
    return json_reply(200, asked(request));
  } catch (const Refused& why) {
    return refusal(request, 403, why.what());
  } catch (const Overtaken& why) {
    return problem(409, why.what());
  } catch (const nlohmann::json::exception& why) {
    return problem(400, fmt::format("the question is not as expected: {}; load the page again", why.what()));
  } catch (const InputError& why) {
    return problem(400, why.what());
  } catch (const plugins::PluginFailure& why) {
    return problem(500, fmt::format("nothing goes on with this plugin: {}. Report this to its author", why.what()));
  } catch (const std::exception& why) {
    return problem(500, why.what());
  }
}

}  // namespace tunica::app::studio
