// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <future>
#include <map>
#include <memory>
#include <mutex>

namespace patina {

/// An object as part of a key: known again while it lives, and not kept alive.
template <class T> class Reference {
public:
    Reference(const std::shared_ptr<T>& object) : _address(object.get()), _object(object) {}
    bool is(const std::shared_ptr<T>& object) const {
        return object.get() == _address && (!_address || !_object.expired());
    }

private:
    const void* _address;
    std::weak_ptr<T> _object;
};

/// Values that take long to make, made once for all threads that request the same one. A value
/// lives as long as somebody holds it. A thread that requests a value in the making waits for it.
/// If making fails, all waiting threads get the same exception, and the next request tries again.
/// Thread safe.
/// @tparam Key is made from a request; `bool isOf(const Request&)` compares it with another one
template <class Request, class Key, class Made> class MadeOnce {
public:
    using Pointer = std::shared_ptr<const Made>;

    /// @param of what the request is about: others are not looked at
    /// @param make () -> Pointer
    template <class Make> Pointer get(const void* of, const Request& request, const Make& make) {
        std::promise<Pointer> promise;
        typename Entries::iterator entry;
        {
            std::unique_lock<std::mutex> lock(_mutex);
            const auto range = _entries.equal_range(of);
            for (auto it = range.first; it != range.second; ++it) {
                if (!it->second.key.isOf(request)) continue;
                if (Pointer known = it->second.made.lock()) return known;
                if (!it->second.pending.valid()) continue;
                const std::shared_future<Pointer> pending = it->second.pending;
                lock.unlock();
                return pending.get();
            }
            forgetUnused();
            entry = _entries.emplace(of, Entry{Key(request), {}, promise.get_future().share()});
            ++_count;
        }
        Pointer made;
        try {
            // A thread that took up other work while it waits could wait for who waits for this.
            runIsolated([&] { made = make(); });
        } catch (...) {
            promise.set_exception(std::current_exception());
            const std::lock_guard<std::mutex> lock(_mutex);
            _entries.erase(entry);
            throw;
        }
        promise.set_value(made);
        const std::lock_guard<std::mutex> lock(_mutex);
        entry->second.made = made;
        entry->second.pending = {};
        return made;
    }

    size_t count() const { ///< made or tried, since this was made
        const std::lock_guard<std::mutex> lock(_mutex);
        return _count;
    }

private:
    struct Entry {
        Key key;
        std::weak_ptr<const Made> made;
        std::shared_future<Pointer> pending; ///< while a thread makes it
    };
    using Entries = std::multimap<const void*, Entry>;

    void forgetUnused() {
        if (_entries.size() < _forgetAt) return;
        for (auto it = _entries.begin(); it != _entries.end();) {
            const Entry& entry = it->second;
            it =
                !entry.pending.valid() && entry.made.expired() ? _entries.erase(it) : std::next(it);
        }
        _forgetAt = std::max<size_t>(64, 2 * _entries.size());
    }

    mutable std::mutex _mutex;
    Entries _entries;
    size_t _count = 0, _forgetAt = 64; ///< so many entries are looked through
};

} // namespace patina
