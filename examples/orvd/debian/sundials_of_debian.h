// SUNDIALS of Debian counts with 64 bits; who asks for 32 gets them, and what is passed on is converted.
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cstdint>

#define sunindextype std::int32_t
