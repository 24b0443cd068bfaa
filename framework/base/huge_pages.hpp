#pragma once

// Include this file in exactly one source file of a program that links jemalloc, never in a
// library, which must not make this choice.

/// The options that jemalloc reads from its program (its manual, `TUNING`): use pages of 2 MiB and
/// keep memory that has been used. On a virtual machine, a page fault for 4 KiB costs more than the
/// computation on that page, and tables larger than a cache need fewer TLB entries. Nothing in the
/// program refers to this variable.
extern "C" {
[[gnu::used]] inline const char* malloc_conf = "thp:always,dirty_decay_ms:-1,muzzy_decay_ms:-1";
}
