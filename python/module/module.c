/* The installed module railstrata._core: this file is empty, the code stands in librailstrata-python.so, which it asks
   for. The loader takes that library for the processor at hand (lib/glibc-hwcaps), and Python finds PyInit__core in
   what the module has brought along. */
extern const char railstrata_module[];
const char railstrata_module[] = "railstrata._core";
