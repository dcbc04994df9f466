// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Where the code of plugins lies in memory: names the plugin whose own thread ends the process, which no call leads
/// to.
namespace tunica::plugins {

/// The library behind a handle of dlopen() is that of the plugin. Said again, the new name counts.
void note_image(void* handle, const std::string& plugin);

/// The plugin that holds this address; null where none does. Signal handlers may ask.
const char* plugin_at(const void* address);

/// The innermost plugin that this thread is in by its return addresses; null where none is. Signal handlers may ask.
const char* plugin_on_the_stack();

}  // namespace tunica::plugins
