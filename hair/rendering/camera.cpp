#include "hair/rendering/camera.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace hair {

glm::mat4 viewProjection(const CameraSettings& camera, float aspect) {
    glm::mat4 projection = glm::perspectiveRH_ZO(
        glm::radians(camera.field_of_view), aspect, camera.near_plane, camera.far_plane);
    projection[1][1] = -projection[1][1];
    return projection * glm::lookAtRH(camera.position, camera.target, camera.up);
}

}  // namespace hair
