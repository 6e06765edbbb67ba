// What the tests in C++ share: a check that ends the program and says where.

#ifndef SPIRAL_ATLAS_CHECK_HPP
#define SPIRAL_ATLAS_CHECK_HPP

#include <cstdio>
#include <cstdlib>

#define CHECK(condition)                                                                  \
    do {                                                                                  \
        if (!(condition)) {                                                               \
            std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
            std::exit(1);                                                                 \
        }                                                                                 \
    } while (0)

#endif
