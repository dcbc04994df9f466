// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "plugins/loader.hpp"
#include "temporary_folder.hpp"

// Each way of being no plugin, and its own message: what was expected, what was found, what to do.
namespace tunica::plugins {
namespace {

namespace fs = std::filesystem;
using testing::copy_plugin;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::string reason_for(const fs::path& file, bool allow_world_writable = false) {
  Catalogue catalogue;
  try {
    load_file(file, catalogue, allow_world_writable);
  } catch (const LoadError& refusal) {
    EXPECT_TRUE(catalogue.optimizers().empty()) << "nothing of a refused plugin is taken";
    return refusal.what();
  }
  return "loaded";
}

std::string reason_for_bad(const std::string& name) {
  const TemporaryFolder folder;
  return reason_for(copy_plugin(name, folder.path()));
}

void open_to_everyone(const fs::path& path) { fs::permissions(path, fs::perms::others_write, fs::perm_options::add); }

TEST(Refusal, WrongApiNumber) {
  EXPECT_EQ(reason_for_bad("wrong_api"), "it was built for plugin API " + std::to_string(TUNICA_PLUGIN_API + 41) +
                                             "; expected " + std::to_string(TUNICA_PLUGIN_API) +
                                             "; rebuild the plugin with the headers and the compiler of this tunica");
}

TEST(Refusal, OtherFingerprintShowsTheFieldsThatDifferAndNoOthers) {
  const std::string ours = TUNICA_ABI_FINGERPRINT;
  const std::size_t begin = ours.find("alignment ") + std::string("alignment ").size();
  const std::string alignment = ours.substr(begin, ours.find(';', begin) - begin);
  EXPECT_EQ(reason_for_bad("other_fingerprint"),
            "its binary interface differs: alignment: expected " + alignment +
                ", found 64; rebuild the plugin with the headers and the compiler of this tunica");
}

TEST(Refusal, HeaderOfAnotherSize) {
  EXPECT_EQ(reason_for_bad("other_struct_size"),
            "its header has 8 bytes; expected " + std::to_string(sizeof(PluginHeader)) +
                "; rebuild the plugin with the headers and the compiler of this tunica");
}

TEST(Refusal, MissingSymbol) {
  EXPECT_EQ(reason_for_bad("missing_symbol"),
            "a shared library, but not a plugin: it exports no symbol 'tunica_plugin'; define the plugin with "
            "TUNICA_PLUGIN(), or take the file out of the plugin path");
}

TEST(Refusal, NullHeader) {
  EXPECT_EQ(reason_for_bad("null_header"),
            "tunica_plugin() returned a null pointer; expected the plugin's header; define it with TUNICA_PLUGIN()");
}

TEST(Refusal, NoName) {
  EXPECT_EQ(reason_for_bad("no_name"), "its header has no name; expected a text; give TUNICA_PLUGIN() a name");
}

TEST(Refusal, NoRegisterFunction) {
  EXPECT_EQ(reason_for_bad("no_register_function"),
            "plugin 'no_register_function 0.1.0' has no register function; expected one; define the plugin with "
            "TUNICA_PLUGIN()");
}

TEST(Refusal, RegistrationThatThrows) {
  EXPECT_EQ(reason_for_bad("throwing_registration"),
            "registration of plugin 'throwing_registration 0.1.0' failed: the table of materials is missing; expected "
            "it to return normally; nothing of the plugin was taken");
}

TEST(Refusal, RegistrationThatThrowsANumber) {
  EXPECT_EQ(
      reason_for_bad("non_standard_throw"),
      "registration of plugin 'non_standard_throw 0.1.0' threw something that is not a std::exception; expected it "
      "to return normally; nothing of the plugin was taken");
}

TEST(Refusal, DefaultOutsideItsOwnBounds) {
  EXPECT_EQ(reason_for_bad("default_outside_bounds"),
            "plugin 'default_outside_bounds 0.1.0': the optimiser 'too_many_starts': the option 'starts' has the "
            "default 20, outside its own bounds; expected 10 or less; correct the declaration");
}

TEST(Refusal, UndefinedSymbolIsNamed) {
  EXPECT_EQ(reason_for_bad("undefined_symbol"),
            "it needs the symbol 'nobody_defines_this', which neither it nor a library it is linked with defines; link "
            "the missing library, and build with -Wl,-z,defs to see such gaps at link time");
}

TEST(Refusal, NotALibrary) {
  const TemporaryFolder folder;
  EXPECT_EQ(reason_for(folder.write("text.so", "model = gho\n")),
            "not a shared library: it does not begin with the ELF signature; expected the plugin's compiled .so file");
  EXPECT_THAT(reason_for(folder.write("empty.so", "")), HasSubstr("not a shared library"));
}

// To map one ends the process with SIGBUS, from about a page on.
TEST(Refusal, TruncatedLibrary) {
  const TemporaryFolder folder;
  const fs::path file = copy_plugin("good", folder.path());
  const auto size = fs::file_size(file);
  fs::resize_file(file, size - 1);
  EXPECT_EQ(reason_for(file), "the file is cut short: it has " + std::to_string(size - 1) +
                                  " bytes, and its headers speak of " + std::to_string(size) +
                                  "; expected a whole shared library; copy or build it again");
  for (const std::uintmax_t left : {size / 2, size / 4, std::uintmax_t{4096}, std::uintmax_t{64}, std::uintmax_t{40}}) {
    fs::resize_file(file, left);
    EXPECT_THAT(reason_for(file), HasSubstr("the file is cut short: it has " + std::to_string(left) + " bytes"));
  }
}

TEST(Refusal, MissingFileAndFolderInsteadOfAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(reason_for(folder.path() / "nowhere.so"),
            "no such file; expected a plugin (a shared library); check the path");
  EXPECT_EQ(reason_for(folder.subfolder("folder.so")),
            "found something other than a regular file; expected a shared library");
}

TEST(Refusal, WorldWritableFile) {
  const TemporaryFolder folder;
  const fs::path file = copy_plugin("good", folder.path());
  open_to_everyone(file);
  EXPECT_EQ(reason_for(file),
            "the file can be written by every user, so that any of them could run code as you; expected a file "
            "writable by its owner only; run: chmod o-w '" +
                file.string() + "' (or pass --allow-world-writable-plugins)");
  EXPECT_EQ(reason_for(file, true), "loaded") << "the override";
}

TEST(Refusal, WorldWritableFolder) {
  const TemporaryFolder folder;
  const fs::path open = folder.subfolder("open");
  const fs::path file = copy_plugin("good", open);
  open_to_everyone(open);
  EXPECT_EQ(reason_for(file),
            "its folder can be written by every user, so that any of them could replace it; expected a folder "
            "writable by its owner only; run: chmod o-w '" +
                open.string() + "' (or pass --allow-world-writable-plugins)");
  EXPECT_EQ(reason_for(file, true), "loaded") << "the override";
}

TEST(Refusal, FileOrFolderThatAGroupCanWrite) {
  const TemporaryFolder folder;
  const fs::path shared = folder.subfolder("shared");
  const fs::path file = copy_plugin("good", shared);
  constexpr unsigned foreign = 65533;  // a group of nobody's own
  if (::chown(file.c_str(), static_cast<uid_t>(-1), foreign) != 0) GTEST_SKIP() << "only root gives groups away";
  EXPECT_EQ(reason_for(file), "loaded") << "the group may read";
  fs::permissions(file, fs::perms::group_write, fs::perm_options::add);
  EXPECT_EQ(reason_for(file),
            "the file can be written by its group, so that any member could run code as you; expected a file writable "
            "by its owner only; run: chmod g-w '" +
                file.string() + "' (or pass --allow-world-writable-plugins)");
  EXPECT_EQ(reason_for(file, true), "loaded") << "the override";
  fs::permissions(file, fs::perms::group_write, fs::perm_options::remove);
  ASSERT_EQ(::chown(shared.c_str(), static_cast<uid_t>(-1), foreign), 0);
  fs::permissions(shared, fs::perms::group_write, fs::perm_options::add);
  EXPECT_THAT(reason_for(file), HasSubstr("its folder can be written by its group, so that any member could replace "));
}

TEST(Refusal, FileOrFolderOfAnotherUser) {
  const TemporaryFolder folder;
  const fs::path theirs = folder.subfolder("theirs");
  const fs::path file = copy_plugin("good", theirs);
  constexpr unsigned other = 65533;
  if (::chown(file.c_str(), other, static_cast<gid_t>(-1)) != 0) GTEST_SKIP() << "only root gives files away";
  EXPECT_THAT(reason_for(file), HasSubstr("the file belongs to the user number 65533, who could run code as you; "
                                          "expected one that belongs to you or to root; take a copy of your own"));
  EXPECT_EQ(reason_for(file, true), "loaded") << "the override";
  ASSERT_EQ(::chown(file.c_str(), ::geteuid(), static_cast<gid_t>(-1)), 0);
  ASSERT_EQ(::chown(theirs.c_str(), other, static_cast<gid_t>(-1)), 0);
  EXPECT_THAT(reason_for(file), HasSubstr("its folder belongs to the user number 65533, who could replace it"));
}

TEST(Refusal, FolderAboveThatOthersCanWriteUnlessItIsSticky) {
  const TemporaryFolder folder;
  const fs::path above = folder.subfolder("above");
  const fs::path file = copy_plugin("good", folder.subfolder("above/between/plugins"));
  fs::permissions(above / "between", fs::perms::owner_all);
  EXPECT_EQ(reason_for(file), "loaded");
  open_to_everyone(above);
  EXPECT_EQ(reason_for(file),
            "the folder '" + above.string() +
                "' above it can be written by every user, so that any of them could replace what lies below; expected "
                "a folder writable by its owner only; run: chmod o-w '" +
                above.string() + "' (or pass --allow-world-writable-plugins)");
  fs::permissions(above, fs::perms::sticky_bit, fs::perm_options::add);
  EXPECT_EQ(reason_for(file), "loaded") << "as below /tmp";
}

TEST(Refusal, FolderAboveOfAnotherUserOrThatAGroupCanWrite) {
  const TemporaryFolder folder;
  const fs::path above = folder.subfolder("above");
  const fs::path file = copy_plugin("good", folder.subfolder("above/plugins"));
  constexpr unsigned other = 65534;
  if (::chown(above.c_str(), static_cast<uid_t>(-1), other) != 0) GTEST_SKIP() << "only root gives folders away";
  EXPECT_EQ(reason_for(file), "loaded") << "the group may read";
  fs::permissions(above, fs::perms::group_write, fs::perm_options::add);
  EXPECT_EQ(reason_for(file),
            "the folder '" + above.string() +
                "' above it can be written by its group, so that any member could replace what lies below; expected a "
                "folder writable by its owner only; run: chmod g-w '" +
                above.string() + "' (or pass --allow-world-writable-plugins)");
  EXPECT_EQ(reason_for(file, true), "loaded") << "the override";
  fs::permissions(above, fs::perms::group_write, fs::perm_options::remove);
  ASSERT_EQ(::chown(above.c_str(), other, static_cast<gid_t>(-1)), 0);
  EXPECT_THAT(reason_for(file), HasSubstr("the folder '" + above.string() + "' above it belongs to the user "));
  fs::permissions(above, fs::perms::sticky_bit, fs::perm_options::add);
  EXPECT_THAT(reason_for(file), HasSubstr("above it belongs to the user ")) << "its owner may replace all the same";
}

TEST(Refusal, ALinkDoesNotHideAWorldWritableFolder) {
  const TemporaryFolder folder;
  const fs::path open = folder.subfolder("open"), closed = folder.subfolder("closed");
  copy_plugin("good", open);
  fs::create_symlink(open / "good.so", closed / "good.so");
  EXPECT_EQ(reason_for(closed / "good.so"), "loaded") << "a link as such is fine";
  open_to_everyone(open);
  EXPECT_THAT(reason_for(closed / "good.so"), HasSubstr("chmod o-w '" + open.string() + "'"));
}

TEST(Refusal, TheOverrideReachesWholeFolders) {
  const TemporaryFolder folder;
  copy_plugin("good", folder.path());
  open_to_everyone(folder.path());
  Catalogue refusing, allowing;
  EXPECT_EQ(load_all({{folder.path()}}, refusing).refused.size(), 1u);
  EXPECT_EQ(load_all({{folder.path()}, true}, allowing).loaded.size(), 1u);
}

}  // namespace
}  // namespace tunica::plugins
