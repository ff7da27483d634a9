// What is costly to make and is needed again and again, by one thread at a time.
#pragma once

#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace oro {

// A thing out of those that lie idle, or a new one; put back at the end. Owner is a std::unique_ptr, and
// `make` gives one; null where there is no memory. Lent, and not a thread's own: glibc aborts when it has no
// memory to enter what a thread must destroy. Throws std::bad_alloc.
template <class Owner, Owner (*make)()>
class PooledObject {
  public:
    PooledObject() {
        {
            const std::scoped_lock lock(idle().mutex);
            if (!idle().things.empty()) {
                thing_ = std::move(idle().things.back());
                idle().things.pop_back();
            }
        }
        if (!thing_) thing_ = make();
        if (!thing_) throw std::bad_alloc();
    }
    PooledObject(const PooledObject&) = delete;
    PooledObject& operator=(const PooledObject&) = delete;
    ~PooledObject() {
        try {
            const std::scoped_lock lock(idle().mutex);
            idle().things.push_back(std::move(thing_));
        } catch (const std::bad_alloc&) {  // then it is destroyed
        }
    }
    [[nodiscard]] typename Owner::pointer get() const { return thing_.get(); }

  private:
    struct Idle {
        std::mutex mutex;
        std::vector<Owner> things;
    };
    static Idle& idle() {
        static Idle all;
        return all;
    }

    Owner thing_;
};

}  // namespace oro
