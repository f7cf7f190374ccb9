#pragma once

#include "engine/error.h"

namespace engine {

// The device stopped working (VK_ERROR_DEVICE_LOST), and so did everything made from it.
class DeviceLost : public Error {
public:
    using Error::Error;
};

}  // namespace engine
