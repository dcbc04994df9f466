// SPDX-License-Identifier: Apache-2.0
#include "plugins/guarded.hpp"

#include <gtest/gtest.h>

#include "plugins/loader.hpp"
#include "temporary_folder.hpp"

namespace tunica::plugins {
namespace {

template <class Exception, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Exception& problem) {
    return problem.what();
  }
  return "no exception";
}

TEST(Guarded, PassesResultsThrough) {
  EXPECT_EQ(guarded("x 1", "describe", [] { return 42; }), 42);
  int calls = 0;
  guarded("x 1", "describe", [&calls] { ++calls; });
  EXPECT_EQ(calls, 1);
}

TEST(Guarded, KeepsWrongInputApartFromBrokenPromises) {
  EXPECT_EQ(message_of<InputError>(
                [] { guarded("x 1", "describe", [] { throw InputError("'kappa' is 2, expected at most 1/3"); }); }),
            "plugin 'x 1': 'kappa' is 2, expected at most 1/3");
  EXPECT_EQ(message_of<PluginFailure>([] { guarded("x 1", "describe", [] { throw std::out_of_range("index 7"); }); }),
            "plugin 'x 1' failed: index 7");
  EXPECT_EQ(message_of<PluginFailure>([] { guarded("x 1", "describe", [] { throw 42; }); }),
            "plugin 'x 1' threw something that is not a std::exception");
}

TEST(Guarded, LackOfMemoryIsNoBrokenPromiseButASizeThatCannotBeIsOne) {
  EXPECT_EQ(message_of<std::bad_alloc>([] { guarded("x 1", "create", [] { throw std::bad_alloc(); }); }),
            "plugin 'x 1' failed: std::bad_alloc");
  EXPECT_EQ(message_of<PluginFailure>([] { guarded("x 1", "create", [] { throw std::bad_array_new_length(); }); }),
            "plugin 'x 1' failed: std::bad_array_new_length");
}

TEST(Guarded, ANullObjectIsABrokenPromise) {
  const Catalogue::Entry<ModelFactory> entry{
      {"gho", "", "", {}, [](const Options&) -> std::unique_ptr<Model> { return nullptr; }}, "gho 0.1.0"};
  EXPECT_EQ(message_of<PluginFailure>([&] { create(entry, Options()); }),
            "plugin 'gho 0.1.0' made no object: its factory returned a null pointer");
}

// A file could not say which one it means.
TEST(Guarded, TwoParametersOfOneNameAreRefused) {
  const Parameter mu{"mu", "kPa", 10, 0.1, 1000, Scale::log, "", "none"};
  EXPECT_EQ(message_of<InputError>([&] { refuse_equal_names({mu}, "x 1", "model"); }), "no exception");
  EXPECT_EQ(message_of<InputError>([&] {
              refuse_equal_names({mu, mu}, "x 1", "model");
            }).substr(0, 57),
            "plugin 'x 1' made a model with two parameters named 'mu',");
}

TEST(Guarded, TurnsExceptionsOfARealPluginIntoHostTypes) {
  const testing::TemporaryFolder folder;
  Catalogue catalogue;
  load_file(testing::copy_plugin("good", folder.path()), catalogue);
  EXPECT_EQ(message_of<InputError>([&] { create(catalogue.models().at("wrong_input"), Options()); }),
            "plugin 'good 1.2.3': 'layers' must be at least 1, found 0");
  EXPECT_EQ(message_of<PluginFailure>([&] { create(catalogue.models().at("own_exception"), Options()); }),
            "plugin 'good 1.2.3' failed: an exception of the plugin's own type");
  EXPECT_NE(create(catalogue.optimizers().at("does_nothing"), Options()), nullptr);
}

}  // namespace
}  // namespace tunica::plugins
