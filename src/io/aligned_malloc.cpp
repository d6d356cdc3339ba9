// SPDX-License-Identifier: BSD-3-Clause
//
// Stands in for MRPT's function of this name, which gives null where there is no memory; its
// vectors then write there. This one throws, as allocators do, so a file that claims too much can
// be refused. The dynamic linker takes it because cca_io comes before MRPT among a program's
// libraries.
#include <mrpt/core/aligned_allocator.h>

#include <cstdlib>
#include <new>

void* mrpt::aligned_malloc(size_t size, size_t alignment) {
  const size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* const memory = std::aligned_alloc(alignment, whole < size ? size : whole))
    return memory;
  throw std::bad_alloc();
}
