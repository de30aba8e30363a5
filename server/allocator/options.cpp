// What the service asks of its allocator, jemalloc.
//
// The threads that read requests, trace and answer free what others allocated, thousands of times a
// second: that takes jemalloc less time than glibc, and it gives back what is not used.

/// Read by jemalloc before main() ("TUNING" in jemalloc(3)); where its names have a prefix, as in
/// Homebrew's, its defaults hold. Blocks of less than 64 MB are kept for the next use, a minute in
/// which somebody who tries one setting after the other comes back, but in the first of its arenas:
/// to give those of an image back and get them anew, zeroed, page by page, takes as long as tracing
/// a simple picture. A thread of jemalloc's gives back what nobody used, in an idle process too.
extern "C" {
extern const char* const malloc_conf;
const char* const malloc_conf =
    "oversize_threshold:67108864,background_thread:true,dirty_decay_ms:60000";
}
