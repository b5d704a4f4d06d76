! The module tetlod on a generated mesh: kinds, sections, index bases, failures, callbacks.
module module_tests
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use test_expect
  use tetlod
  implicit none
  integer, parameter :: cells = 8, row = cells + 1, points = row**3, tets = 6 * cells**3
  real(real64), target :: xyz(3, points), values(points)
  integer(int32), target :: corners(4, tets)

  type :: tally
    integer :: calls = 0
  end type
  type :: vertex
    real(real64) :: place(3), value
  end type
  ! What a callback may not do with the context that calls it.
  type :: meddler
    type(tetlod_context) :: lod
    integer :: calls = 0, refused = 0
  end type

contains

  pure integer function node(p)
    integer, intent(in) :: p(3)
    node = 1 + p(1) + row * (p(2) + row * p(3))
  end function

  ! A cube of cells, each six tets around its diagonal, one for each order of the axes; a linear field.
  subroutine make_mesh()
    integer, parameter :: order(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
    integer :: i, j, k, path, step, t, p(3)
    t = 0
    do k = 0, cells
      do j = 0, cells
        do i = 0, cells
          xyz(:, node([i, j, k])) = [i, j, k]
          values(node([i, j, k])) = i + 2 * j - 3 * k
          if (max(i, j, k) == cells) cycle
          do path = 1, 6
            t = t + 1
            p = [i, j, k]
            corners(1, t) = node(p)
            do step = 1, 3
              p(order(step, path)) = p(order(step, path)) + 1
              corners(step + 1, t) = node(p)
            end do
          end do
        end do
      end do
    end do
  end subroutine

  subroutine begin(lod)
    type(tetlod_context), intent(inout) :: lod
    call lod%create()
    call lod%set_rho(0.2)
    call lod%set_sigma(1d0)
  end subroutine

  subroutine submit_mesh(lod)
    type(tetlod_context), intent(inout) :: lod
    call lod%submit_points(xyz)
    call lod%submit_tets(corners)
    call lod%submit_scalars("linear", values)
  end subroutine

  ! The hash of the result's bytes, after a look at the result.
  integer(int64) function finish(lod) result(hash)
    type(tetlod_context), intent(inout) :: lod
    type(tetlod_run_report) :: report
    real(real64), allocatable :: xyz(:, :), values(:)
    integer(int64), allocatable :: small(:, :), zero_based(:, :)
    integer(int32), allocatable :: faces(:, :)
    integer(int64) :: n, m, k
    call lod%run()
    call lod%fetch_report(report)
    call lod%fetch_counts(n, m, k)
    call lod%fetch_points(xyz)
    call lod%fetch_scalars(values)
    call lod%fetch_tets(small)
    call lod%fetch_tets(zero_based, index_base=0)
    call lod%fetch_boundary(faces)
    call expect(m < tets .and. m > 0, "fewer tets")
    call expect(all(shape(xyz) == [3_int64, n]) .and. all(shape(small) == [4_int64, m]), "shapes")
    call expect(size(faces, 2) == k .and. minval(faces) == 1, "boundary")
    call expect(minval(small) == 1 .and. maxval(small) == n .and. all(small == zero_based + 1), "index base")
    call expect(all(abs(values - (xyz(1, :) + 2 * xyz(2, :) - 3 * xyz(3, :))) < 1d-9), "the linear field is exact")
    hash = report%hash
    call lod%destroy()
  end function

  subroutine test_layouts()
    real(real64), allocatable, target :: big(:, :, :), table(:, :)
    real(real32), allocatable, target :: single(:, :), single_values(:)
    integer(int64), allocatable, target :: long(:, :)
    integer(int32), allocatable :: counted(:, :)
    type(tetlod_context) :: lod
    integer(int64) :: packed
    integer :: stat
    allocate (big(2, 5, 2 * points), long(6, tets))
    call begin(lod)
    call submit_mesh(lod)
    packed = finish(lod)
    call expect(finish_records() == packed, "a view of derived types gives the bytes of packed arrays")

    big = -1d300
    big(2, 4:2:-1, 2 * points:2:-2) = xyz
    big(1, 5, 1:2 * points:2) = values
    long(5:2:-1, tets:1:-1) = corners - 1
    call begin(lod)
    call lod%submit_points(big(2, 4:2:-1, 2 * points:2:-2))
    call lod%submit_tets(long(5:2:-1, tets:1:-1), index_base=0)
    call lod%submit_scalars("linear", big(1, 5, 1:2 * points:2))
    call expect(finish(lod) == packed, "sections give the bytes of packed arrays")

    table = transpose(xyz)
    single = real(xyz, real32)
    single_values = real(values, real32)
    call begin(lod)
    call lod%submit_points_xyz(table(:, 1), table(:, 2), table(:, 3))
    call lod%submit_tets(corners)
    call lod%submit_scalars("linear", single_values)
    call expect(finish(lod) == packed, "separate coordinates, real32 values")
    call begin(lod)
    call lod%submit_points(single)
    call lod%submit_tets(corners)
    call lod%submit_scalars("linear", values)
    call expect(finish(lod) == packed, "real32 points")
    ! Borrowed, not copied: what changes before the run counts.
    call begin(lod)
    call lod%submit_points(big(2, 4:2:-1, 2 * points:2:-2))
    call lod%submit_tets(corners)
    call lod%submit_scalars("linear", values)
    big(2, 2, :) = 2 * big(2, 2, :)
    call lod%run()
    call check_height(lod, 2d0 * cells)
    call lod%fetch_tets(counted, index_base=5, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. .not. allocated(counted), "counted from 5")
    call lod%destroy()
  end subroutine

  ! Lent, as README tells for components of derived types.
  integer(int64) function finish_records() result(hash)
    type(vertex), target :: vertices(points)
    real(real64), pointer :: numbers(:, :)
    type(tetlod_context) :: lod
    integer :: i
    vertices = [(vertex(xyz(:, i), values(i)), i=1, points)]
    call c_f_pointer(c_loc(vertices), numbers, [4, points])
    call begin(lod)
    call lod%submit_points(numbers(1:3, :))
    call lod%submit_tets(corners)
    call lod%submit_scalars("linear", numbers(4, :))
    hash = finish(lod)
  end function

  subroutine check_height(lod, height)
    type(tetlod_context), intent(in) :: lod
    real(real64), intent(in) :: height
    real(real64), pointer :: view(:, :)
    call lod%view_points(view)
    call expect(maxval(view(3, :)) >= height, "the library reads the section itself")
  end subroutine

  subroutine test_failures()
    type(tetlod_context) :: lod
    real(real64), target :: flat(2, 4), one(3, 1)
    real(real64), allocatable :: out(:, :)
    real(real64), allocatable, target :: wide(:, :)
    integer(int32), pointer :: seen(:, :)
    real(real64) :: rho
    type(tetlod_bounds) :: bounds
    character(len=200) :: message
    integer :: stat
    message = "untouched"
    call lod%run(stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "create") > 0, "no context")
    call lod%set_progress(stop_at_once, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "a callback without a context")
    call lod%create(remesher="", stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "config: remesher") == 1, "no remesher: "//message)
    call lod%create(stat=stat, errmsg=message)
    message = "untouched"
    call lod%set_rho(0.25d0, stat=stat, errmsg=message)
    call expect(stat == TETLOD_OK .and. message == "untouched", "errmsg is left alone on success")
    call lod%create(stat=stat)
    call expect(stat == TETLOD_ERR_STATE, "created twice")
    call lod%set_rho(2.0, stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_OPTION .and. index(message, "rho") > 0, "rho 2")
    call lod%get_real(TETLOD_OPT_RHO, rho)
    call expect(abs(rho - 0.25d0) < tiny(rho), "rho unchanged")
    call lod%set_real(TETLOD_OPT_CLEAN_EDGES, 0.1, stat=stat)
    call lod%get_real(TETLOD_OPT_CLEAN_EDGES, rho)
    call expect(stat == TETLOD_OK .and. abs(rho - 0.1d0) < tiny(rho), "the largest value, rounded up")
    call lod%set_real(TETLOD_OPT_CLEAN_EDGES, 0.11, stat=stat)
    call expect(stat == TETLOD_ERR_OPTION, "more than that")
    call lod%set_real(TETLOD_OPT_CLEAN_EDGES, 0.0)
    flat = 0
    one = 0
    call lod%submit_points(flat, stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "2 components") > 0, "two components")
    call lod%submit_points(one, stat=stat)
    call expect(stat == TETLOD_OK, "one point")
    call lod%submit_points(one(:, 2:1), stat=stat)
    call expect(stat == TETLOD_OK, "no points")
    call lod%fetch_points(out, stat=stat)
    call expect(stat == TETLOD_ERR_STATE .and. .not. allocated(out), "nothing to fetch")
    seen => corners
    call lod%view_tets(seen, stat=stat)
    call expect(stat == TETLOD_ERR_STATE .and. .not. associated(seen), "nothing to see")
    allocate (wide(4294967299_int64, 0))  ! three more than an integer of 32 bits counts
    call lod%submit_points(wide, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "more components than fit")
    call tetlod_option_bounds(TETLOD_OPT_RHO, bounds)
    call expect(all(nint([bounds%least, bounds%most]) == [0, 1]) .and. bounds%is_integer == 0, "bounds of rho")
    call tetlod_option_bounds(-1, bounds, stat=stat)
    call expect(stat == TETLOD_ERR_OPTION, "bounds of nothing")
    call expect(tetlod_option_from_name("rho  ") == TETLOD_OPT_RHO, "option from name")
    call expect(tetlod_option_name(TETLOD_OPT_SEED) == "seed", "option name")
    call expect(tetlod_option_name(-1) == "", "no option name")
    call lod%destroy()
    call lod%destroy()
    call lod%create(memory_limit=-1_int64, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "a negative memory limit")
  end subroutine

  ! Whichever of the two is destroyed first.
  subroutine test_copies()
    type(tetlod_context) :: lod, copy
    integer :: stat
    call lod%create()
    copy = lod
    call lod%destroy()
    call copy%set_rho(0.5, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "a copy of what was destroyed is no context")
    call copy%destroy()
    call copy%create(stat=stat)
    call expect(stat == TETLOD_OK, "it can be created anew")
    call copy%destroy()
  end subroutine

  subroutine stop_at_once(stage, fraction, cancel, user)
    integer(int32), intent(in) :: stage
    real(real64), intent(in) :: fraction
    logical, intent(inout) :: cancel
    class(*), pointer, intent(in) :: user
    call expect(len(tetlod_stage_name(stage)) > 0 .and. fraction >= 0 .and. fraction <= 1, "stage and fraction")
    select type (user)
    type is (tally)
      user%calls = user%calls + 1
    end select
    cancel = .true.
  end subroutine

  subroutine test_callbacks()
    type(tetlod_context) :: lod
    type(tally), target :: counted
    integer :: stat
    call begin(lod)
    call submit_mesh(lod)
    call lod%set_progress(stop_at_once, user=counted)
    call lod%run(stat=stat)
    call expect(stat == TETLOD_ERR_CANCELLED .and. counted%calls >= 1, "the progress procedure cancels")
    call lod%set_progress()
    call lod%run(stat=stat)
    call expect(stat == TETLOD_OK, "runs again without it")
    call lod%destroy()
  end subroutine

  subroutine meddle(m)
    type(meddler), intent(inout) :: m
    type(tally), target :: mine
    integer :: stat(4)
    call m%lod%set_progress(stat=stat(1))
    call m%lod%set_progress(stop_at_once, user=mine, stat=stat(2))
    call m%lod%set_log(stat=stat(3))
    call m%lod%set_rho(0.5, stat=stat(4))
    call m%lod%destroy()
    m%calls = m%calls + 1
    m%refused = m%refused + count(stat == TETLOD_ERR_STATE)
  end subroutine

  subroutine meddle_in_progress(stage, fraction, cancel, user)
    integer(int32), intent(in) :: stage
    real(real64), intent(in) :: fraction
    logical, intent(inout) :: cancel
    class(*), pointer, intent(in) :: user
    call expect(stage >= 0 .and. fraction >= 0 .and. .not. cancel, "stage, fraction and cancel")
    select type (user)
    type is (meddler)
      call meddle(user)
    end select
  end subroutine

  subroutine meddle_in_log(level, message, user)
    integer(int32), intent(in) :: level
    character(len=*), intent(in) :: message
    class(*), pointer, intent(in) :: user
    call expect(level >= 0 .and. len(message) > 0, "level and message")
    select type (user)
    type is (meddler)
      call meddle(user)
    end select
  end subroutine

  subroutine test_calls_inside_progress()
    type(meddler), target :: m
    type(tetlod_context) :: lod
    integer :: run, before, stat
    call begin(lod)
    call submit_mesh(lod)
    call lod%set_progress(meddle_in_progress, user=m)
    m%lod = lod
    do run = 1, 2
      before = m%calls
      call lod%run(stat=stat)
      call expect(stat == TETLOD_OK, "a run whose callbacks call the context")
      call expect(m%calls > before, "what was set is called, also in the next run")
    end do
    call expect(m%refused == 4 * m%calls, "calls inside the progress procedure are refused")
    call lod%set_progress()
    before = m%calls
    call expect(finish(lod) /= 0 .and. m%calls == before, "it is not called any more")
    call lod%run(stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "outside destroy ends the context")
  end subroutine

  ! A program that is no worker, and complains: what it says is logged.
  subroutine test_calls_inside_log()
    type(meddler), target :: m
    type(tetlod_context) :: lod
    integer :: run, stat
    call lod%create(remesher="/bin/cp")
    call submit_mesh(lod)
    call lod%set_log(meddle_in_log, min_level=0, user=m)
    m%lod = lod
    do run = 1, 2
      call lod%run(stat=stat)
      call expect(stat == TETLOD_ERR_BACKEND_MISSING .and. m%calls >= run, "logged, what was set is called again")
    end do
    call expect(m%refused == 4 * m%calls, "calls inside the log procedure are refused")
    call lod%destroy()
  end subroutine
end module

program test_module
  use module_tests
  implicit none
  type(tetlod_context) :: none
  character(len=99) :: message
  if (command_argument_count() == 1) call none%run()
  if (command_argument_count() == 2) call none%run(errmsg=message)
  if (command_argument_count() > 0) stop "the program goes on"
  call make_mesh()
  call test_layouts()
  call test_failures()
  call test_copies()
  call test_callbacks()
  call test_calls_inside_progress()
  call test_calls_inside_log()
  if (failures > 0) error stop "the module tetlod fails"
  print '("ok: ", a)', tetlod_build_info()
end program
