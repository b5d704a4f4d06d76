! The functions of tetlod.h as they are: tetlod_x is c_x here. For the modules of this folder; programs use module
! tetlod.
module tetlod_c
  use, intrinsic :: iso_c_binding, only: c_double, c_funptr, c_int32_t, c_int64_t, c_ptr, c_size_t
  use tetlod_types, only: tetlod_array, tetlod_bounds, tetlod_config, tetlod_error_report, tetlod_mesh_report, &
    tetlod_run_report
  implicit none
  public

  interface
    subroutine c_version(major, minor, patch) bind(C, name="tetlod_version")
      import
      integer(c_int32_t), intent(inout) :: major, minor, patch
    end subroutine
    function c_build_info() result(answer) bind(C, name="tetlod_build_info")
      import
      type(c_ptr) :: answer
    end function
    function c_status_text(status) result(answer) bind(C, name="tetlod_status_text")
      import
      integer(c_int32_t), value :: status
      type(c_ptr) :: answer
    end function
    function c_stage_name(stage) result(answer) bind(C, name="tetlod_stage_name")
      import
      integer(c_int32_t), value :: stage
      type(c_ptr) :: answer
    end function
    function c_create(config, out) result(status) bind(C, name="tetlod_create")
      import
      type(tetlod_config), intent(in) :: config
      type(c_ptr), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    subroutine c_destroy(context) bind(C, name="tetlod_destroy")
      import
      type(c_ptr), value :: context
    end subroutine
    function c_last_message(context, buffer, capacity) result(answer) bind(C, name="tetlod_last_message")
      import
      type(c_ptr), value :: context, buffer
      integer(c_size_t), value :: capacity
      integer(c_size_t) :: answer
    end function
    function c_set_log(context, fn, user, min_level) result(status) bind(C, name="tetlod_set_log")
      import
      type(c_ptr), value :: context, user
      type(c_funptr), value :: fn
      integer(c_int32_t), value :: min_level
      integer(c_int32_t) :: status
    end function
    function c_set_progress(context, fn, user) result(status) bind(C, name="tetlod_set_progress")
      import
      type(c_ptr), value :: context, user
      type(c_funptr), value :: fn
      integer(c_int32_t) :: status
    end function
    subroutine c_cancel(context) bind(C, name="tetlod_cancel")
      import
      type(c_ptr), value :: context
    end subroutine
    function c_set_rho(context, rho) result(status) bind(C, name="tetlod_set_rho")
      import
      type(c_ptr), value :: context
      real(c_double), value :: rho
      integer(c_int32_t) :: status
    end function
    function c_set_sigma(context, sigma) result(status) bind(C, name="tetlod_set_sigma")
      import
      type(c_ptr), value :: context
      real(c_double), value :: sigma
      integer(c_int32_t) :: status
    end function
    function c_set_lambda(context, lambda) result(status) bind(C, name="tetlod_set_lambda")
      import
      type(c_ptr), value :: context
      real(c_double), value :: lambda
      integer(c_int32_t) :: status
    end function
    function c_set_min_distance(context, fraction) result(status) bind(C, name="tetlod_set_min_distance")
      import
      type(c_ptr), value :: context
      real(c_double), value :: fraction
      integer(c_int32_t) :: status
    end function
    function c_set_preset(context, preset) result(status) bind(C, name="tetlod_set_preset")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: preset
      integer(c_int32_t) :: status
    end function
    function c_set_real(context, option, value) result(status) bind(C, name="tetlod_set_real")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: option
      real(c_double), value :: value
      integer(c_int32_t) :: status
    end function
    function c_set_int(context, option, value) result(status) bind(C, name="tetlod_set_int")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: option
      integer(c_int64_t), value :: value
      integer(c_int32_t) :: status
    end function
    function c_get_real(context, option, out) result(status) bind(C, name="tetlod_get_real")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: option
      real(c_double), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_get_int(context, option, out) result(status) bind(C, name="tetlod_get_int")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: option
      integer(c_int64_t), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_option_bounds(option, out) result(status) bind(C, name="tetlod_option_bounds")
      import
      integer(c_int32_t), value :: option
      type(tetlod_bounds), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_option_from_name(name) result(answer) bind(C, name="tetlod_option_from_name")
      import
      type(c_ptr), value :: name
      integer(c_int32_t) :: answer
    end function
    function c_option_name(option) result(answer) bind(C, name="tetlod_option_name")
      import
      integer(c_int32_t), value :: option
      type(c_ptr) :: answer
    end function
    function c_submit_points(context, xyz) result(status) bind(C, name="tetlod_submit_points")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(in) :: xyz
      integer(c_int32_t) :: status
    end function
    function c_submit_points_xyz(context, x, y, z) result(status) bind(C, name="tetlod_submit_points_xyz")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(in) :: x, y, z
      integer(c_int32_t) :: status
    end function
    function c_submit_tets(context, corners, index_base) result(status) bind(C, name="tetlod_submit_tets")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(in) :: corners
      integer(c_int32_t), value :: index_base
      integer(c_int32_t) :: status
    end function
    function c_submit_scalars(context, name, values) result(status) bind(C, name="tetlod_submit_scalars")
      import
      type(c_ptr), value :: context, name
      type(tetlod_array), intent(in) :: values
      integer(c_int32_t) :: status
    end function
    function c_submit_steering(context, name, weight, values) result(status) bind(C, name="tetlod_submit_steering")
      import
      type(c_ptr), value :: context, name
      real(c_double), value :: weight
      type(tetlod_array), intent(in) :: values
      integer(c_int32_t) :: status
    end function
    function c_submit_field(context, name, association, values) result(status) bind(C, name="tetlod_submit_field")
      import
      type(c_ptr), value :: context, name
      integer(c_int32_t), value :: association
      type(tetlod_array), intent(in) :: values
      integer(c_int32_t) :: status
    end function
    function c_withdraw_field(context, name) result(status) bind(C, name="tetlod_withdraw_field")
      import
      type(c_ptr), value :: context, name
      integer(c_int32_t) :: status
    end function
    function c_submit_point_flags(context, flags) result(status) bind(C, name="tetlod_submit_point_flags")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(in) :: flags
      integer(c_int32_t) :: status
    end function
    function c_clear(context) result(status) bind(C, name="tetlod_clear")
      import
      type(c_ptr), value :: context
      integer(c_int32_t) :: status
    end function
    function c_check(context, out) result(status) bind(C, name="tetlod_check")
      import
      type(c_ptr), value :: context
      type(tetlod_mesh_report), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_estimate_memory(context, bytes) result(status) bind(C, name="tetlod_estimate_memory")
      import
      type(c_ptr), value :: context
      integer(c_int64_t), intent(inout) :: bytes
      integer(c_int32_t) :: status
    end function
    function c_run(context) result(status) bind(C, name="tetlod_run")
      import
      type(c_ptr), value :: context
      integer(c_int32_t) :: status
    end function
    function c_measure_error(context, samples_per_tet, out) result(status) bind(C, name="tetlod_measure_error")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: samples_per_tet
      type(tetlod_error_report), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_histogram(context, side, bins, counts) result(status) bind(C, name="tetlod_histogram")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: side, bins
      integer(c_int64_t), intent(inout) :: counts(*)
      integer(c_int32_t) :: status
    end function
    function c_fetch_counts(context, points, tets, boundary_triangles) &
        result(status) bind(C, name="tetlod_fetch_counts")
      import
      type(c_ptr), value :: context
      integer(c_int64_t), intent(inout) :: points, tets, boundary_triangles
      integer(c_int32_t) :: status
    end function
    function c_fetch_points(context, dst) result(status) bind(C, name="tetlod_fetch_points")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(inout) :: dst
      integer(c_int32_t) :: status
    end function
    function c_fetch_tets(context, index_base, dst) result(status) bind(C, name="tetlod_fetch_tets")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: index_base
      type(tetlod_array), intent(inout) :: dst
      integer(c_int32_t) :: status
    end function
    function c_fetch_boundary(context, index_base, dst) result(status) bind(C, name="tetlod_fetch_boundary")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: index_base
      type(tetlod_array), intent(inout) :: dst
      integer(c_int32_t) :: status
    end function
    function c_fetch_scalars(context, dst) result(status) bind(C, name="tetlod_fetch_scalars")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(inout) :: dst
      integer(c_int32_t) :: status
    end function
    function c_fetch_field(context, name, dst) result(status) bind(C, name="tetlod_fetch_field")
      import
      type(c_ptr), value :: context, name
      type(tetlod_array), intent(inout) :: dst
      integer(c_int32_t) :: status
    end function
    function c_fetch_stencil(context, index_base, ids, weights) result(status) bind(C, name="tetlod_fetch_stencil")
      import
      type(c_ptr), value :: context
      integer(c_int32_t), value :: index_base
      type(tetlod_array), intent(inout) :: ids, weights
      integer(c_int32_t) :: status
    end function
    function c_transfer(context, original, simplified) result(status) bind(C, name="tetlod_transfer")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(in) :: original
      type(tetlod_array), intent(inout) :: simplified
      integer(c_int32_t) :: status
    end function
    function c_fetch_report(context, out) result(status) bind(C, name="tetlod_fetch_report")
      import
      type(c_ptr), value :: context
      type(tetlod_run_report), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_view_points(context, out) result(status) bind(C, name="tetlod_view_points")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_view_tets(context, out) result(status) bind(C, name="tetlod_view_tets")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
    function c_view_scalars(context, out) result(status) bind(C, name="tetlod_view_scalars")
      import
      type(c_ptr), value :: context
      type(tetlod_array), intent(inout) :: out
      integer(c_int32_t) :: status
    end function
  end interface
end module
