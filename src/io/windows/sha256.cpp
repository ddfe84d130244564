#include <fmt/format.h>
#include <windows.h>
// after windows.h, whose types it takes
#include <bcrypt.h>

#include <array>

#include "core/faults.hpp"
#include "io/provenance.hpp"

namespace railstrata {

std::string sha256_of(std::string_view bytes) {
  std::array<unsigned char, 32> digest{};
  auto* const text = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));
  BCRYPT_ALG_HANDLE algorithm = nullptr;
  const bool done = BCRYPT_SUCCESS(::BCryptOpenAlgorithmProvider(&algorithm, BCRYPT_SHA256_ALGORITHM, nullptr, 0)) &&
                    BCRYPT_SUCCESS(::BCryptHash(algorithm, nullptr, 0, text, static_cast<ULONG>(bytes.size()),
                                                digest.data(), static_cast<ULONG>(digest.size())));
  if (algorithm != nullptr) ::BCryptCloseAlgorithmProvider(algorithm, 0);
  if (!done) throw EnvironmentError("bcrypt.dll has no SHA-256");
  std::string out;
  for (const unsigned char byte : digest) out += fmt::format("{:02x}", byte);
  return out;
}

}  // namespace railstrata
