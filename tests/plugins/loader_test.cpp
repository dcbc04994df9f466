// SPDX-License-Identifier: Apache-2.0
#include "plugins/loader.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/error.hpp"

namespace tunica::plugins {
namespace {

using testing::copy_plugin;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

std::vector<std::string> names(const std::vector<LoadedPlugin>& loaded) {
  std::vector<std::string> names;
  for (const LoadedPlugin& plugin : loaded) names.push_back(plugin.name);
  return names;
}

TEST(Loader, ReportsNameVersionAndFileOfAPlugin) {
  const TemporaryFolder folder;
  const auto file = copy_plugin("good", folder.path());
  Catalogue catalogue;
  const LoadedPlugin loaded = load_file(file, catalogue);
  EXPECT_EQ(loaded.name, "good");
  EXPECT_EQ(loaded.version, "1.2.3");
  EXPECT_EQ(loaded.file, file);
  EXPECT_EQ(catalogue.optimizers().at("does_nothing").plugin, "good 1.2.3");
}

/// A variable of the environment while it lives.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name_); }

 private:
  const char* name_;
};

std::string complaint_about_level(const std::string& level) {
  const Environment variable("TUNICA_VECTOR_LEVEL", level);
  Catalogue catalogue;
  try {
    static_cast<void>(load_all({}, catalogue));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "";
}

TEST(Loader, RefusesVectorLevelsThatAreNone) {
  EXPECT_EQ(complaint_about_level("avx9"),
            "TUNICA_VECTOR_LEVEL is 'avx9'; expected baseline, avx2 or avx512, or leave the variable out");
  EXPECT_EQ(complaint_about_level("baseline"), "");
  EXPECT_EQ(complaint_about_level(detail::name(detail::best_vector_level())), "");
  if (detail::best_vector_level() == detail::VectorLevel::avx512) return;
  EXPECT_THAT(
      complaint_about_level("avx512"),
      HasSubstr("TUNICA_VECTOR_LEVEL is 'avx512', which this machine or this build does not offer; the highest is"));
}

TEST(Loader, LoadsTheGoodOnesOfAFolderFullOfBadOnes) {
  const TemporaryFolder folder;
  for (const auto& entry : std::filesystem::directory_iterator(TUNICA_BAD_PLUGIN_DIR)) {
    copy_plugin(entry.path().stem().string(), folder.path());
  }
  const auto text = folder.write("a_text.so", "this is no library\n");
  const auto note = folder.write("README.txt", "not looked at\n");
  // The good plugin comes after others that are refused; the one that takes its name comes after it.
  std::filesystem::rename(folder.path() / "duplicate_name.so", folder.path() / "zz_duplicate_name.so");
  Catalogue catalogue;
  const LoadReport report = load_all({{folder.path()}}, catalogue);
  EXPECT_THAT(names(report.loaded), ElementsAre("good"));
  std::map<std::string, std::string> reasons;
  for (const RefusedPlugin& refusal : report.refused) reasons[refusal.file.filename()] = refusal.reason;
  EXPECT_EQ(reasons.size(), 13u) << "each with a reason";
  EXPECT_THAT(reasons.at("a_text.so"), HasSubstr("not a shared library"));
  EXPECT_EQ(reasons.at("zz_duplicate_name.so"),
            "plugin 'duplicate_name 0.1.0': the optimiser 'does_nothing' is already provided by plugin 'good 1.2.3', "
            "and names must be unique; rename it, or leave one of the two plugins out of the plugin path");
  // Nothing of a refused plugin stays, neither the half-registered nor the one with one name taken.
  EXPECT_EQ(catalogue.optimizers().size(), 1u);
  EXPECT_EQ(catalogue.models().size(), 2u);
}

TEST(Loader, SearchesFoldersInOrderAndEachOnce) {
  const TemporaryFolder folder;
  const auto first = folder.subfolder("first"), second = folder.subfolder("second");
  copy_plugin("good", first);
  copy_plugin("good", second);
  Catalogue catalogue;
  const LoadReport report = load_all({{first, second, first / "." / ".." / "first"}}, catalogue);
  ASSERT_EQ(report.loaded.size(), 1u);
  EXPECT_EQ(report.loaded[0].file, first / "good.so");
  ASSERT_EQ(report.refused.size(), 1u) << "the second folder's copy, and the first folder only once";
  EXPECT_EQ(report.refused[0].file, second / "good.so");
  EXPECT_THAT(report.refused[0].reason, HasSubstr("already provided by plugin 'good 1.2.3'"));
}

TEST(Loader, ReportsFoldersThatAreMissingOrNoFolders) {
  const TemporaryFolder folder;
  const auto file = folder.write("plugins", "");
  Catalogue catalogue;
  const LoadReport report = load_all({{folder.path() / "nowhere", file}}, catalogue);
  EXPECT_THAT(report.loaded, IsEmpty());
  ASSERT_EQ(report.refused.size(), 2u);
  EXPECT_EQ(report.refused[0].file, folder.path() / "nowhere");
  EXPECT_EQ(report.refused[0].reason, "no such folder; expected a folder with plugins; check the plugin path");
  EXPECT_EQ(report.refused[1].reason, "found a file; expected a folder with plugins; name the folder it lies in");
}

TEST(Loader, TakesEveryPluginOfTheBuild) {
  Catalogue catalogue;
  const LoadReport report = load_all({{TUNICA_PLUGIN_DIR}, true}, catalogue);
  for (const RefusedPlugin& refusal : report.refused) ADD_FAILURE() << refusal.file << ": " << refusal.reason;
  EXPECT_FALSE(report.loaded.empty());
}

}  // namespace
}  // namespace tunica::plugins
