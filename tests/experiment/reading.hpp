// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "experiment/design_example.hpp"
#include "experiment/experiment.hpp"
#include "experiment/fake_catalogue.hpp"
#include "tunica/error.hpp"

namespace tunica::testing {

/// Reads variants of the design's example, in a folder with its data.
class Reading : public ::testing::Test {
 protected:
  Reading() {
    static_cast<void>(folder.write("circ.csv", circ_csv));
    static_cast<void>(folder.write("circ2.csv", circ_csv));
    static_cast<void>(folder.write("inflation.csv", inflation_csv));
  }

  /// The example with one piece of its text replaced; the piece must occur.
  static std::string with(std::string_view piece, std::string_view replacement, std::string text = design_example) {
    const std::size_t at = text.find(piece);
    EXPECT_NE(at, std::string::npos) << "the example has no " << piece;
    if (at != std::string::npos) text.replace(at, piece.size(), replacement);
    return text;
  }

  [[nodiscard]] experiment::Experiment read(std::string_view text) const {
    return experiment::read_experiment(folder.write("experiment.json", text), fake_catalogue());
  }

  /// The message with which a text is refused, without its folder; "" if it is not.
  [[nodiscard]] std::string refusal(std::string_view text) const {
    std::string message = message_of<InputError>([&] { static_cast<void>(read(text)); });
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) message.erase(at, prefix.size());
    return message;
  }
  [[nodiscard]] std::string refusal(std::string_view piece, std::string_view replacement) const {
    return refusal(with(piece, replacement));
  }

  Folder folder;
};

inline void expect_within(std::string_view message, std::string_view part) {
  EXPECT_NE(message.find(part), std::string_view::npos) << "the message is: " << message << "\nand lacks: " << part;
}

}  // namespace tunica::testing
