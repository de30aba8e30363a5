// What the service asks of its allocator, jemalloc.
//
// The threads that read requests, trace and answer free what others allocated, thousands of times a
// second: jemalloc takes half as long over it as glibc, and gives memory back that is not used.

/// Read by jemalloc before main() ("TUNING" in jemalloc(3)). Blocks of less than 64 MB are kept a
/// few seconds for the next use: to give those of an image back and get them anew, zeroed, page by
/// page, takes as long as tracing a simple picture. A thread of jemalloc's gives back what nobody
/// used, in an idle process too.
extern "C" {
extern const char* const malloc_conf;
const char* const malloc_conf = "oversize_threshold:67108864,background_thread:true";
}
