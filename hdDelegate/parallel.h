// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef PATINA_PLAIN_THREADS
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>
#endif

namespace patina {

#ifdef PATINA_PLAIN_THREADS

namespace parallelDetail {
inline thread_local int limit = 0;         ///< threads of the arena this thread is in; 0: no arena
inline thread_local bool isWorker = false; ///< nested loops run on the thread that meets them
} // namespace parallelDetail

/// Calls body(i) for every i in [begin, end), in no particular order, on threads made for the call.
/// ThreadSanitizer sees how these synchronise, while it does not see inside TBB, which is not
/// instrumented. The first exception ends the loop early and is thrown to the caller.
template <class Index, class Body> void parallelFor(Index begin, Index end, const Body& body) {
    if (!(begin < end)) return;
    const size_t count = size_t(end - begin);
    const size_t wanted =
        parallelDetail::limit > 0
            ? size_t(parallelDetail::limit)
            : std::max<size_t>(2, std::thread::hardware_concurrency()); // one finds no races
    const size_t threads = std::min(wanted, count);
    if (threads < 2 || parallelDetail::isWorker) {
        for (Index i = begin; i < end; ++i)
            body(i);
        return;
    }
    std::atomic<size_t> next{0};
    std::mutex mutex;
    std::exception_ptr error;
    const auto work = [&] {
        parallelDetail::isWorker = true;
        try {
            // Relaxed: any stronger order would hide races between iterations from the sanitizer.
            for (size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;)
                body(Index(begin + Index(i)));
        } catch (...) {
            next.store(count, std::memory_order_relaxed);
            std::lock_guard<std::mutex> lock(mutex);
            if (!error) error = std::current_exception();
        }
        parallelDetail::isWorker = false;
    };
    std::vector<std::thread> others;
    try {
        for (size_t i = 1; i < threads; ++i)
            others.emplace_back(work);
    } catch (const std::system_error&) {
        // No more threads to be had: those there are do all of it.
    }
    work();
    for (std::thread& other : others)
        other.join();
    if (error) std::rethrow_exception(error);
}

/// Calls body(*it) for every iterator of the random-access range [begin, end).
template <class Iterator, class Body>
void parallelForEach(Iterator begin, Iterator end, const Body& body) {
    parallelFor(size_t(0), size_t(end - begin), [&](size_t i) { body(begin[i]); });
}

/// Calls body(first, last) for ranges that together are [begin, end).
template <class Body> void parallelRanges(int begin, int end, const Body& body) {
    const int size = 16;
    parallelFor(0, (std::max(begin, end) - begin + size - 1) / size,
                [&](int i) { body(begin + i * size, std::min(begin + (i + 1) * size, end)); });
}

/// Runs body such that this thread takes up no other work meanwhile: here it never does.
template <class Body> void runIsolated(const Body& body) {
    body();
}

/// Where loops run on a number of threads of their own.
class Arena {
public:
    /// @param threads how many; 0 or less: as many as the machine has
    explicit Arena(int threads) : _threads(threads) {}
    template <class Body> void execute(const Body& body) {
        struct Restore {
            int limit = parallelDetail::limit;
            ~Restore() { parallelDetail::limit = limit; }
        } restore;
        parallelDetail::limit = std::max(_threads, 0);
        body();
    }

private:
    int _threads;
};

#else

/// Calls body(i) for every i in [begin, end), in no particular order, on TBB's threads. The first
/// exception ends the loop early and is thrown to the caller.
template <class Index, class Body> void parallelFor(Index begin, Index end, const Body& body) {
    // Of inlined copies, one may have a * b + c in one instruction and another in two. Which copy
    // an index meets depends on the threads, so there is a single one.
    tbb::parallel_for(
        begin, end, [&](Index i) __attribute__((noinline)) { body(i); });
}

/// Calls body(*it) for every iterator of the random-access range [begin, end).
template <class Iterator, class Body>
void parallelForEach(Iterator begin, Iterator end, const Body& body) {
    tbb::parallel_for_each(begin, end, body);
}

/// Calls body(first, last) for ranges that together are [begin, end).
template <class Body> void parallelRanges(int begin, int end, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<int>(begin, end),
                      [&](const tbb::blocked_range<int>& r) { body(r.begin(), r.end()); });
}

/// Runs body such that this thread takes up no other work while it waits in there.
template <class Body> void runIsolated(const Body& body) {
    tbb::this_task_arena::isolate(body);
}

/// Where loops run on a number of threads of their own.
class Arena {
public:
    /// @param threads how many; 0 or less: as many as the machine has
    explicit Arena(int threads) : _arena(threads > 0 ? threads : int(tbb::task_arena::automatic)) {}
    template <class Body> void execute(const Body& body) { _arena.execute(body); }

private:
    tbb::task_arena _arena;
};

#endif

} // namespace patina
