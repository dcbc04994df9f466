// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "answer.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "exit_codes.hpp"
#include "studio/desk.hpp"
#include "studio/project_folder.hpp"
#include "supervisor.hpp"
#include "text/aside.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

namespace fs = std::filesystem;

struct StudioOptions {
  std::string folder = ".";
  int port = 0;
  bool no_browser = false;
};

/// Paths of plugins are the user's, and the project is another folder.
GlobalOptions with_absolute_paths(GlobalOptions global) {
  for (std::string& path : global.plugin_paths) path = fs::absolute(path).string();
  return global;
}

void enter(const std::string& folder) {
  std::error_code problem;
  if (!fs::is_directory(folder, problem))
    throw InputError(fmt::format("{}: there is no such folder; make it, or name another one", folder));
  fs::current_path(folder, problem);
  if (problem)
    throw InputError(fmt::format("{}: cannot be opened: {}; name another folder", folder, problem.message()));
}

/// One server a project: two would write the same records. The lock goes with the process.
void hold_project() {
  const fs::path lock = studio::own_place() / "lock";
  const int descriptor = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (descriptor < 0)
    throw InputError(fmt::format("{}: cannot be written; check the permissions of the project", lock.string()));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    throw InputError("another `tunica studio` serves this folder; open the address that it has printed, or end it");
}

/// A page that leads to the address, for its owner only: command lines are read by everybody on the machine.
std::string way_to(const std::string& address) {
  const fs::path file = studio::own_place() / "open.html";
  std::error_code none;
  fs::remove(file, none);
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  const std::string page = fmt::format(
      "<!doctype html><title>tunica studio</title><meta http-equiv=\"refresh\" content=\"0;url={}\">", address);
  if (descriptor < 0) return {};
  const bool whole = ::write(descriptor, page.data(), page.size()) == static_cast<ssize_t>(page.size());
  ::close(descriptor);
  return whole ? fs::absolute(file).string() : std::string();
}

/// Of the desktop; where there is none, the address is printed anyway. It has a session of its own, which Ctrl-C of the
/// terminal does not reach.
void open_browser(const std::string& address) {
  std::string program = "xdg-open", file = way_to(address);
  if (file.empty()) return;
  char* words[] = {program.data(), file.data(), nullptr};
  posix_spawnattr_t apart;
  ::posix_spawnattr_init(&apart);
  ::posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETSID);
  posix_spawn_file_actions_t silent;
  ::posix_spawn_file_actions_init(&silent);
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&silent, descriptor, "/dev/null", O_WRONLY, 0);
  pid_t process = -1;
  const bool begun = ::posix_spawnp(&process, program.c_str(), &silent, &apart, words, environ) == 0;
  ::posix_spawn_file_actions_destroy(&silent);
  ::posix_spawnattr_destroy(&apart);
  if (begun) std::thread([process] { ::waitpid(process, nullptr, 0); }).detach();
}

int serve_page(const GlobalOptions& asked, const StudioOptions& options) {
  const GlobalOptions global = with_absolute_paths(asked);
  const Session session(global);
  enter(options.folder);
  hold_project();
  const execution::InterruptWatch interrupts;
  studio::Doorkeeper door;
  studio::Jobs jobs(session, plugin_words(global));
  studio::Desk desk(session, door, jobs);
  studio::WebService service;
  service.port = options.port;
  service.largest_body = studio::largest_upload;
  service.refused = [&](const studio::WebRequest& request) {
    auto stopped = door.stopped(request);
    return stopped ? std::move(stopped) : studio::Desk::refused_body(request);
  };
  service.answer = [&](const studio::WebRequest& request) { return desk(request); };
  service.listening = [&](int port) {
    door.opened_at(port);
    if (supervised::successor()) return;  // it is said
    answer("{}\n", door.address());
    flush_answer();
    supervised::serves();
    text::aside("the page of {}, for this machine and whoever has the address; Ctrl-C ends it\n",
                fs::current_path().string());
    if (!options.no_browser) open_browser(door.address());
  };
  service.over = [] { return execution::InterruptWatch::interrupted(); };
  studio::serve_web(service);
  return done;
}

}  // namespace

void add_studio(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<StudioOptions>();
  auto* verb = app.add_subcommand("studio", "Work in the browser: from a file of a rig to a diagnosis and a card");
  verb->add_option("folder", options->folder, "Project: a folder of experiments, files and results (default: this one)")
      ->type_name("DIR");
  verb->add_option("--port", options->port, "Port; 0 = any that is free (default: 0)")
      ->check(CLI::Range(0, 65535))
      ->type_name("N");
  verb->add_flag("--no-browser", options->no_browser, "Print the address, and open no browser");
  verb->footer(
      "Examples:\n"
      "  tunica studio\n"
      "  tunica studio my_project --no-browser --port 4300\n\n"
      "It listens on this machine only, and reads and writes nothing outside the folder. A fit of an external test\n"
      "starts the program that the test names, which may do what you may.");
  verb->callback([&global, &action, options] { action = [&global, options] { return serve_page(global, *options); }; });
}

}  // namespace tunica::app
