/* The explorer for a page: one request after the other, from one thread. */
#ifndef RAILSTRATA_EXPLORE_CALLS_H
#define RAILSTRATA_EXPLORE_CALLS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Answers a request; both are JSON (explore/solve.hpp). The text holds until the next call. */
const char* rs_explore(const char* request);
/* The arrays of the last answer, and how many numbers they have together. */
const float* rs_explore_numbers(void);
int rs_explore_count(void);

#ifdef __cplusplus
}
#endif
#endif
