/* Stands in for libcurl and libcrypto beside the HDF5 of a wheel or a tarball. Debian's HDF5 links both for files in
   Amazon's S3, which RailStrata never opens; with them some 25 libraries would have to come along. */
#include <stddef.h>

int curl_global_init(long flags) {
  (void)flags;
  return 2; /* CURLE_FAILED_INIT */
}
void curl_global_cleanup(void) {}
void* curl_easy_init(void) { return NULL; }
void curl_easy_cleanup(void* handle) { (void)handle; }
int curl_easy_setopt(void* handle, int option, ...) {
  (void)handle;
  (void)option;
  return 2;
}
int curl_easy_perform(void* handle) {
  (void)handle;
  return 2;
}
void* curl_slist_append(void* list, const char* text) {
  (void)list;
  (void)text;
  return NULL;
}
void curl_slist_free_all(void* list) { (void)list; }

const void* EVP_sha256(void) { return NULL; }
void* HMAC(void) { return NULL; }
void* SHA256(void) { return NULL; }
