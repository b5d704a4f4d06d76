! What the module tetlod gives back of a mesh, a run and its result: each kind of array, and the counts.
module results_tests
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use test_box
  use tetlod
  implicit none

contains

  subroutine begin(lod)
    type(tetlod_context), intent(inout) :: lod
    call lod%create()
    call submit_box(lod)
    call lod%run()
  end subroutine

  subroutine test_counts()
    type(tetlod_context) :: lod
    type(tetlod_run_report) :: report
    integer(int32) :: n, m, k
    integer(int64) :: wide(3)
    call begin(lod)
    call lod%fetch_report(report)
    call lod%fetch_counts(n, m, k)
    call lod%fetch_counts(wide(1), wide(2), wide(3))
    call expect(all([n, m, k] == wide), "counts of int32")
    call expect(all(wide == [report%points_out, report%tets_out, report%boundary_triangles_out]), "counts of int64")
    n = -1
    call lod%fetch_counts(n)
    call expect(n == wide(1), "the count of points alone")
    call lod%destroy()
  end subroutine

  subroutine test_views()
    type(tetlod_context) :: lod
    real(real64), pointer :: seen(:, :), seen_values(:)
    integer(int32), pointer :: seen_tets(:, :)
    real(real64), allocatable :: points(:, :), fetched(:)
    integer(int32), allocatable :: corners(:, :)
    call begin(lod)
    call lod%view_points(seen)
    call lod%view_tets(seen_tets)
    call lod%view_scalars(seen_values)
    call lod%fetch_points(points)
    call lod%fetch_tets(corners)
    call lod%fetch_scalars(fetched)
    call expect(all(shape(seen) == shape(points)) .and. all(same(seen, points)), "points seen are those fetched")
    call expect(all(shape(seen_tets) == shape(corners)) .and. all(seen_tets == corners - 1), "tets, counted from 0")
    call expect(size(seen_values) == size(fetched) .and. all(same(seen_values, fetched)), "values")
    call lod%destroy()
  end subroutine

  subroutine test_single_precision()
    type(tetlod_context) :: lod
    real(real64), allocatable :: points(:, :), fetched(:)
    real(real32), allocatable :: single_points(:, :), single_values(:)
    call begin(lod)
    call lod%fetch_points(points)
    call lod%fetch_points(single_points)
    call lod%fetch_scalars(fetched)
    call lod%fetch_scalars(single_values)
    call expect(all(abs(single_points - real(points, real32)) < tiny(1.0)), "points of real32")
    call expect(all(abs(single_values - real(fetched, real32)) < tiny(1.0)), "values of real32")
    call lod%destroy()
  end subroutine

  ! Six times the volume of the cone from the origin to a triangle.
  pure real(real64) function cone(p)
    real(real64), intent(in) :: p(3, 3)
    cone = p(1, 1) * (p(2, 2) * p(3, 3) - p(3, 2) * p(2, 3)) - p(2, 1) * (p(1, 2) * p(3, 3) - p(3, 2) * p(1, 3)) &
           + p(3, 1) * (p(1, 2) * p(2, 3) - p(2, 2) * p(1, 3))
  end function

  ! Its triangles look outwards, so that they enclose the box.
  subroutine test_boundary()
    type(tetlod_context) :: lod
    real(real64), allocatable :: points(:, :)
    integer(int32), allocatable :: narrow(:, :), from_zero(:, :)
    integer(int64), allocatable :: wide(:, :), wide_from_zero(:, :)
    real(real64) :: volume
    integer :: i
    call begin(lod)
    call lod%fetch_points(points)
    call lod%fetch_boundary(narrow)
    call lod%fetch_boundary(from_zero, index_base=0)
    call lod%fetch_boundary(wide)
    call lod%fetch_boundary(wide_from_zero, index_base=0)
    volume = sum([(cone(points(:, narrow(:, i))), i=1, size(narrow, 2))]) / 6
    call expect(abs(volume - 1) < 1d-12, "the boundary encloses the box")
    call expect(all(from_zero == narrow - 1), "index base 0, int32")
    call expect(all(shape(wide) == shape(narrow)) .and. all(wide == narrow), "triangles of int64")
    call expect(all(wide_from_zero == wide - 1), "index base 0, int64")
    call lod%destroy()
  end subroutine

  ! An eighth is the same number in either precision.
  subroutine test_separate_coordinates()
    type(tetlod_context) :: lod
    type(tetlod_run_report) :: together, apart
    real(real32), allocatable, target :: single(:, :)
    allocate (single, source=real(xyz, real32))
    call begin(lod)
    call lod%fetch_report(together)
    call lod%clear()
    call submit_box(lod)
    call lod%submit_points_xyz(single(1, :), single(2, :), single(3, :))
    call lod%run()
    call lod%fetch_report(apart)
    call expect(apart%hash == together%hash, "separate coordinates of real32")
    call lod%destroy()
  end subroutine

  subroutine test_check()
    type(tetlod_context) :: lod
    type(tetlod_mesh_report) :: report
    integer(int32), allocatable, target :: broken(:, :)
    call lod%create()
    call submit_box(lod)
    call lod%check(report)
    call expect(report%status == TETLOD_OK, "a sound mesh")
    call expect(report%points == size(xyz, 2) .and. report%tets == size(tets, 2), "as many as are submitted")
    call expect(report%index%count == 0 .and. report%index%first == -1, "no culprit")
    broken = tets
    broken(3, 17) = size(xyz, 2) + 1
    call lod%submit_tets(broken)
    call lod%check(report)
    call expect(report%status == TETLOD_ERR_MESH_INDEX, "what run would say")
    call expect(report%index%count == 1 .and. report%index%first == 17, "the culprit, counted from 1")
    call lod%destroy()
  end subroutine

  subroutine test_estimate()
    type(tetlod_context) :: lod
    type(tetlod_run_report) :: report
    integer(int64) :: bytes
    call lod%create()
    call submit_box(lod)
    call lod%estimate_memory(bytes)
    call lod%run()
    call lod%fetch_report(report)
    call expect(2 * bytes > report%peak_bytes .and. bytes < 2 * report%peak_bytes, "an estimate near what was taken")
    call lod%destroy()
  end subroutine

  subroutine test_clear()
    type(tetlod_context) :: lod
    real(real64), allocatable :: points(:, :)
    integer :: stat
    call begin(lod)
    call lod%clear()
    call lod%run(stat=stat)
    call expect(stat == TETLOD_ERR_STATE, "clear forgets what was submitted")
    call lod%fetch_points(points, stat=stat)
    call expect(stat == TETLOD_OK .and. size(points, 2) > 0, "and keeps the result")
    call lod%destroy()
  end subroutine

  subroutine test_error()
    type(tetlod_context) :: lod
    type(tetlod_error_report) :: report
    integer :: stat
    call begin(lod)
    call lod%measure_error(3, report)
    call expect(report%samples_per_tet == 3, "as many samples as asked for")
    call expect(report%max < 1d-9 .and. report%max_inner < 1d-9, "a linear field is exact")
    call lod%measure_error(-1, report, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. report%samples_per_tet == 3, "less than no samples")
    call lod%destroy()
  end subroutine

  subroutine test_histogram()
    type(tetlod_context) :: lod
    integer(int64), allocatable :: counts(:)
    integer(int64) :: n
    integer :: stat
    call begin(lod)
    call lod%fetch_counts(n)
    call lod%histogram(0, 5, counts)
    call expect(size(counts) == 5 .and. sum(counts) == size(values), "all of the original's vertices")
    call lod%histogram(1, 4, counts)
    call expect(size(counts) == 4 .and. sum(counts) == n, "all of the result's")
    call lod%histogram(1, 0, counts, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. .not. allocated(counts), "no bins")
    call lod%histogram(1, huge(0), counts, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. .not. allocated(counts), "too many, and no memory for them")
    call lod%histogram(2, 4, counts, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. .not. allocated(counts), "no such side")
    call lod%destroy()
  end subroutine

  ! An integer is taken from the vertex with the largest weight: here all have the same.
  subroutine test_transfer_of_bytes()
    type(tetlod_context) :: lod
    integer(int8), allocatable, target :: original(:, :), moved(:, :)
    integer(int64) :: n
    call begin(lod)
    call lod%fetch_counts(n)
    allocate (original(2, size(xyz, 2)), moved(2, n))
    original(1, :) = 3_int8
    original(2, :) = -7_int8
    moved = 0_int8
    call lod%transfer(original, moved)
    call expect(all(moved(1, :) == 3_int8) .and. all(moved(2, :) == -7_int8), "transfer of int8")
    call lod%destroy()
  end subroutine
end module

program test_results
  use results_tests
  implicit none
  call make_mesh()
  call test_counts()
  call test_views()
  call test_single_precision()
  call test_boundary()
  call test_separate_coordinates()
  call test_check()
  call test_estimate()
  call test_clear()
  call test_error()
  call test_histogram()
  call test_transfer_of_bytes()
  if (failures > 0) error stop "the results of the module tetlod fail"
  print '("ok")'
end program
