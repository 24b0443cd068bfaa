#pragma once

// For one source of a program that links jemalloc; a library leaves the choice to its program.

/// The options that jemalloc reads from its program (its manual, `TUNING`): pages of 2 MiB, and
/// memory that was used is kept. On a virtual machine a fault of a page of 4 KiB costs more than
/// what is computed from it, and tables that are larger than a cache need few entries of the
/// processor's cache of addresses. Nothing in the program refers to the variable.
extern "C" {
[[gnu::used]] inline const char* malloc_conf = "thp:always,dirty_decay_ms:-1,muzzy_decay_ms:-1";
}
