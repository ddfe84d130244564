#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "core/faults.hpp"
#include "io/provenance.hpp"

namespace railstrata {

std::string sha256_of(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw EnvironmentError("libcrypto has no SHA-256");
  std::string out;
  for (unsigned int i = 0; i < length; ++i) out += fmt::format("{:02x}", digest[i]);
  return out;
}

}  // namespace railstrata
