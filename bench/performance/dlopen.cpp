// SPDX-License-Identifier: Apache-2.0
// bench_dlopen FILE...: loads libraries as the host does and ends; what any program with these plugins needs to start.
#include <cstdio>

#include <dlfcn.h>

int main(int count, char** files) {
  for (int k = 1; k < count; ++k)
    if (dlopen(files[k], RTLD_NOW | RTLD_LOCAL) == nullptr) {
      std::fprintf(stderr, "%s\n", dlerror());
      return 2;
    }
  return 0;
}
