// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session.hpp"
#include "studio/doorkeeper.hpp"
#include "studio/jobs.hpp"
#include "studio/web_server.hpp"
#include "studio/workbench.hpp"

namespace tunica::app::studio {

/// Bytes: of a file of a rig, and of everything else that a page sends.
inline constexpr std::size_t largest_upload = std::size_t{64} << 20U, largest_question = std::size_t{4} << 20U;

/// Which question goes to which function. What the core refuses is answered with 400 and its words, what nobody may ask
/// with 403, and is logged.
class Desk {
 public:
  Desk(const Session& session, const Doorkeeper& door, Jobs& jobs)
      : session_(session), door_(door), jobs_(jobs), workbench_(session) {}

  /// What is too large, before it is read.
  static std::optional<WebReply> refused_body(const WebRequest& request);
  WebReply operator()(const WebRequest& request);

 private:
  WebReply page(const std::string& name) const;
  /// A file of the project, in an origin of its own.
  WebReply shown(const std::string& name) const;
  nlohmann::ordered_json project();
  nlohmann::ordered_json catalogue() const;
  WebReply simulated(const std::string& question);
  nlohmann::ordered_json asked(const WebRequest& request);

  const Session& session_;
  const Doorkeeper& door_;
  Jobs& jobs_;
  Workbench workbench_;
};

}  // namespace tunica::app::studio
