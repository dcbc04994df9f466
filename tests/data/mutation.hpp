// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::testing {

/// Damages a text in one or two places: bytes flipped, pieces cut, repeated, swapped, or replaced by a token. The
/// same seed gives the same damage everywhere (the engine is fixed by the standard; distributions are not used).
class Mutator {
 public:
  Mutator(std::uint64_t seed, std::vector<std::string> tokens) : engine_(seed), tokens_(std::move(tokens)) {}

  std::string operator()(std::string text) {
    const std::size_t times = 1 + below(2);
    for (std::size_t i = 0; i < times && !text.empty(); ++i) damage(text);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

  void damage(std::string& text) {
    const std::size_t at = below(text.size()), length = 1 + below(std::min<std::size_t>(text.size() - at, 12));
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.replace(at, length, tokens_[below(tokens_.size())]);
        break;
      case 4:
        text.insert(at, tokens_[below(tokens_.size())]);
        break;
      default: {
        const std::string piece = text.substr(at, length);
        text.erase(at, length);
        text.insert(below(text.size() + 1), piece);
      }
    }
  }

  std::mt19937_64 engine_;
  std::vector<std::string> tokens_;
};

}  // namespace tunica::testing
