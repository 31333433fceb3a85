#include "frep/base/stack.h"

#include <pthread.h>

namespace frep {

void run_on_stack(std::size_t bytes, const std::function<void()>& body) {
    pthread_attr_t attributes;
    pthread_t thread;
    bool started = false;
    if (pthread_attr_init(&attributes) == 0) {
        auto call = [](void* f) -> void* {
            (*static_cast<const std::function<void()>*>(f))();
            return nullptr;
        };
        void* argument = const_cast<std::function<void()>*>(&body);
        started = pthread_attr_setstacksize(&attributes, bytes) == 0 &&
                  pthread_create(&thread, &attributes, call, argument) == 0;
        pthread_attr_destroy(&attributes);
    }
    if (started)
        pthread_join(thread, nullptr);
    else
        body();
}

}  // namespace frep
