#define VMA_IMPLEMENTATION
#include "engine/memory.h"
