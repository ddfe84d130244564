#pragma once
// A file inside the program.

/// Defines NAME_begin and NAME_end, around the bytes of the file, and a zero behind them. The assembler takes the file
/// in as it is: no array of a million numbers to compile.
#define RAILSTRATA_EMBED(name, file)                                                                        \
  asm(".section .rodata\n.global " #name "_begin\n.global " #name "_end\n" #name "_begin:\n.incbin \"" file \
      "\"\n" #name "_end:\n.byte 0\n.text\n");                                                              \
  extern "C" __attribute__((visibility("hidden"))) const char name##_begin[], name##_end[];
