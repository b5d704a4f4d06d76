! Fields, stencils, transfers and point flags through the module tetlod: known answers on a generated mesh.
module field_tests
  use, intrinsic :: iso_fortran_env, only: int32, int64, int8, real32, real64
  use box_mesh, only: make_box
  use test_expect
  use tetlod
  implicit none
  integer, parameter :: cells = 8
  real(real64), allocatable, target :: xyz(:, :), values(:)
  integer(int32), allocatable, target :: tets(:, :)

contains

  ! A linear field of two components: exact at every point inside, whatever its tet.
  elemental real(real64) function linear(x, y, z, component)
    real(real64), intent(in) :: x, y, z
    integer, intent(in) :: component
    linear = component + 2 * x - component * y + 0.5d0 * z
  end function

  function linear_at(points) result(field)
    real(real64), intent(in) :: points(:, :)
    real(real64) :: field(2, size(points, 2))
    integer :: c
    do c = 1, 2
      field(c, :) = linear(points(1, :), points(2, :), points(3, :), c)
    end do
  end function

  subroutine begin(lod)
    type(tetlod_context), intent(inout) :: lod
    call lod%create()
    call lod%set_rho(0.1)
    call lod%set_sigma(1.0)
    call lod%submit_points(xyz)
    call lod%submit_tets(tets)
    call lod%submit_scalars("bent", values)
  end subroutine

  ! The whole boundary stays, so every vertex of the result is inside and a linear field is exact there.
  subroutine test_point_fields()
    type(tetlod_context) :: lod
    real(real64), allocatable, target :: field(:, :), wide(:, :, :)
    real(real32), allocatable, target :: single(:, :)
    real(real64), allocatable :: small(:, :), points(:, :), wanted(:, :), moved(:, :)
    real(real32), allocatable :: small_single(:, :)
    integer(int64) :: n
    allocate (field, source=linear_at(xyz))
    allocate (single, source=real(field, real32))
    allocate (wide(3, 2, 2 * size(xyz, 2)), source=-1d300)
    wide(2, :, ::2) = field
    call begin(lod)
    call lod%submit_field("double", TETLOD_POINT_FIELD, field)
    call lod%submit_field("single", TETLOD_POINT_FIELD, single)
    call lod%submit_field("section", TETLOD_POINT_FIELD, wide(2, :, ::2))
    call lod%run()
    call lod%fetch_counts(n)
    call lod%fetch_points(points)
    allocate (wanted, source=linear_at(points))
    allocate (small(2, n), small_single(2, n), moved(2, n))
    call lod%fetch_field("double", small)
    call expect(all(abs(small - wanted) < 1d-12), "a linear field is exact")
    moved = -1
    call lod%fetch_field("section", moved)
    call expect(all(same(moved, small)), "a section of a larger array is read in place")
    call lod%fetch_field("single", small_single)
    call expect(all(abs(small_single - wanted) < 1e-5), "real32 in, real32 out")
    moved = -1
    call lod%transfer(field, moved)
    call expect(all(same(moved, small)), "transfer gives the bytes of the run")
    call lod%transfer(single, small_single)
    call expect(all(abs(small_single - wanted) < 1e-5), "transfer of real32")
    call lod%destroy()
  end subroutine

  ! What is not borrowed may be an expression, or a component of an array of a derived type, which gfortran copies.
  subroutine test_temporaries()
    type :: node
      real(real64) :: value, pair(2)
    end type
    type(tetlod_context) :: lod
    type(node), allocatable, target :: nodes(:), small_nodes(:)
    real(real64), allocatable, target :: field(:, :)
    real(real64), allocatable :: small(:), small_pairs(:, :)
    integer, allocatable :: order(:)
    integer(int64) :: n
    integer :: i
    allocate (field, source=linear_at(xyz))
    allocate (nodes(size(xyz, 2)))
    do i = 1, size(nodes)
      nodes(i) = node(field(1, i), field(:, i))
    end do
    order = [(i, i=1, size(nodes))]
    call begin(lod)
    call lod%submit_field("first", TETLOD_POINT_FIELD, field(1, :))
    call lod%run()
    call lod%fetch_counts(n)
    allocate (small(n), small_pairs(2, n), small_nodes(n))
    call lod%transfer(field, small_pairs)
    call lod%transfer(nodes%value, small)
    call expect(all(same(small, small_pairs(1, :))), "transfer of a component")
    call lod%transfer(2 * field, small_pairs)
    call expect(all(same(small_pairs(1, :), 2 * small)), "transfer of an expression")
    small = -1
    call lod%transfer(field(1, order), small)
    call expect(all(same(2 * small, small_pairs(1, :))), "transfer of a vector subscript")
    call lod%transfer(field(1, :), small_nodes%value)
    call expect(all(same(small_nodes%value, small)), "transfer into a component")
    small_nodes%value = -1
    call lod%fetch_field("first", small_nodes%value)
    call expect(all(same(small_nodes%value, small)), "a field fetched into a component")
    call lod%destroy()
  end subroutine

  ! Of one kind and of the other, also a section of a larger array; heavy, it decides where the samples are.
  subroutine test_steering()
    type(tetlod_context) :: lod
    type(tetlod_run_report) :: alone, both
    real(real64), allocatable, target :: wide(:, :)
    real(real32), allocatable, target :: single(:)
    real(real64), allocatable :: points(:, :), small(:, :)
    character(len=200) :: message
    integer(int64) :: n
    integer :: stat
    allocate (wide(3, size(xyz, 2)), source=2 * xyz)
    allocate (single(size(xyz, 2)), source=real(xyz(3, :), real32))
    call begin(lod)
    call lod%run()
    call lod%fetch_report(alone)
    call lod%submit_steering("double", 20d0, wide(2, :))
    call lod%submit_steering("single", 1d0, single)
    call lod%run()
    call lod%fetch_report(both)
    call expect(both%selected_samples > alone%selected_samples, "samples follow the further fields")
    call lod%fetch_counts(n)
    call lod%fetch_points(points)
    allocate (small(1, n))
    call lod%fetch_field("double", small)
    call expect(all(abs(small(1, :) - 2 * points(2, :)) < 1d-12), "a linear field that steers is exact")
    call lod%fetch_field("single", small)
    call expect(all(abs(small(1, :) - points(3, :)) < 1d-6), "real32 steers")
    call lod%submit_steering("single", -1d0, single, stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "weight -1") > 0, "a weight: "//message)
    call lod%withdraw_field("single")
    call lod%withdraw_field("double")
    call lod%run()
    call lod%fetch_report(both)
    call expect(both%selected_samples == alone%selected_samples, "samples follow withdrawn fields no more")
    call lod%withdraw_field("double", stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "double") > 0, "none to withdraw: "//message)
    call lod%destroy()
  end subroutine

  elemental logical function same(a, b)
    real(real64), intent(in) :: a, b
    same = transfer(a, 0_int64) == transfer(b, 0_int64)
  end function

  ! A cell field is looked up, never mixed: the number of a region stays such a number.
  subroutine test_cell_fields()
    type(tetlod_context) :: lod
    real(real64), allocatable, target :: region(:)
    integer(int8), allocatable, target :: mark(:, :)
    integer(int32), allocatable, target :: material(:)
    integer(int64), allocatable, target :: name(:, :)
    real(real64), allocatable :: small(:), points(:, :)
    integer(int8), allocatable :: marks(:)
    integer(int32), allocatable :: corners(:, :), materials(:)
    integer(int64), allocatable :: names(:, :), moved(:, :), wide_materials(:)
    integer(int64) :: n, m
    integer :: t, agreed
    allocate (region(size(tets, 2)))
    do t = 1, size(tets, 2)
      region(t) = merge(7, 3, sum(xyz(1, tets(:, t))) > 2)
    end do
    allocate (material, source=nint(region, int32))
    allocate (mark(2, 3 * size(region)), source=1_int8)
    mark(2, 3::3) = int(-material, int8)
    allocate (name, source=reshape([(2_int64**60 + t, t=1, size(xyz, 2))], [1, size(xyz, 2)]))
    call begin(lod)
    call lod%submit_field("region", TETLOD_CELL_FIELD, region)
    call lod%submit_field("material", TETLOD_CELL_FIELD, material)
    call lod%submit_field("mark", TETLOD_CELL_FIELD, mark(2, 3::3))
    call lod%submit_field("name", TETLOD_POINT_FIELD, name)
    call lod%run()
    call lod%fetch_counts(n, m)
    call lod%fetch_points(points)
    call lod%fetch_tets(corners)
    allocate (small(m))
    call lod%fetch_field("region", small)
    call expect(all(nint(small) == 7 .or. nint(small) == 3), "regions stay regions")
    call expect(all(same(small, anint(small))), "regions are not mixed")
    agreed = 0
    do t = 1, int(m)
      if (nint(small(t)) == merge(7, 3, sum(points(1, corners(:, t))) > 2)) agreed = agreed + 1
    end do
    call expect(agreed == m, "each tet has the region that its centroid is in")
    allocate (materials(m), wide_materials(m), marks(m), names(1, n), moved(1, n))
    call lod%fetch_field("material", materials)
    call lod%fetch_field("material", wide_materials)
    call expect(all(materials == nint(small)) .and. all(wide_materials == materials), "integers of cells")
    call lod%fetch_field("mark", marks)
    call expect(all(marks == -materials), "bytes of cells, from a section")
    call lod%fetch_field("name", names)
    call expect(all(names > 2_int64**60) .and. all(names <= 2_int64**60 + size(xyz, 2)), "integers of points")
    call expect(all(same(xyz(:, names(1, :) - 2_int64**60), points)), "an original is itself")
    call lod%transfer(name, moved)
    call expect(all(moved == names), "transfer of int64")
    call expect(all(transferred(lod) == names(1, :) - 2_int64**60), "transfer of int32")
    call lod%destroy()
  end subroutine

  ! The numbers of the points, in 32 bits.
  function transferred(lod) result(numbers)
    type(tetlod_context), intent(inout) :: lod
    integer(int32), allocatable, target :: number(:), small(:)
    integer(int64), allocatable :: numbers(:)
    integer(int64) :: n
    integer(int32) :: i
    call lod%fetch_counts(n)
    allocate (number, source=[(i, i=1, size(xyz, 2))])
    allocate (small(n))
    call lod%transfer(number, small)
    numbers = small
  end function

  subroutine test_stencils()
    type(tetlod_context) :: lod
    real(real64), allocatable, target :: field(:, :)
    real(real64), allocatable :: weights(:, :), moved(:, :), points(:, :)
    integer(int32), allocatable :: ids(:, :)
    integer(int64), allocatable :: from_zero(:, :)
    integer(int64) :: n
    integer :: i
    allocate (field, source=linear_at(xyz))
    call begin(lod)
    call lod%run()
    call lod%fetch_counts(n)
    call lod%fetch_points(points)
    allocate (ids(4, n), from_zero(4, n), weights(4, n), moved(2, n))
    call lod%fetch_stencil(ids, weights)
    call expect(minval(ids) >= 1 .and. maxval(ids) <= size(xyz, 2), "ids count from 1")
    call expect(all(weights >= 0) .and. all(abs(sum(weights, 1) - 1) < 1d-12), "weights are a mean's")
    call lod%fetch_stencil(from_zero, weights, index_base=0)
    call expect(all(from_zero == ids - 1), "index base 0, int64")
    call lod%transfer(field, moved)
    do i = 1, int(n)
      call expect(all(abs(matmul(xyz(:, ids(:, i)), weights(:, i)) - points(:, i)) < 1d-12), "the mean is the point")
      call expect(all(abs(matmul(field(:, ids(:, i)), weights(:, i)) - moved(:, i)) < 1d-12), "transfer is the mean")
    end do
    call lod%destroy()
  end subroutine

  ! A point inside that nothing else would keep.
  subroutine test_flags()
    type(tetlod_context) :: lod
    integer(int8), allocatable, target :: flags(:)
    integer :: kept
    character(len=200) :: message
    integer :: stat
    kept = 1 + 3 + (cells + 1) * (4 + (cells + 1) * 5)
    allocate (flags(size(values)), source=0_int8)
    call begin(lod)
    call lod%set_rho(1.0)
    call lod%submit_point_flags(flags)
    call lod%run()
    call expect(.not. is_there(lod, xyz(:, kept)), "no flag, no vertex")
    flags(kept) = int(TETLOD_FLAG_KEEP, int8)
    call lod%run()
    call expect(is_there(lod, xyz(:, kept)), "a kept vertex is there")
    flags(kept) = 64_int8
    call lod%run(stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "64") > 0, "a flag without a meaning: "//message)
    call lod%destroy()
  end subroutine

  logical function is_there(lod, point)
    type(tetlod_context), intent(in) :: lod
    real(real64), intent(in) :: point(3)
    real(real64), allocatable :: points(:, :)
    integer :: i
    call lod%fetch_points(points)
    is_there = any([(all(same(points(:, i), point)), i=1, size(points, 2))])
  end function

  subroutine test_failures()
    type(tetlod_context) :: lod
    real(real64), allocatable, target :: field(:, :), narrow(:, :), deep(:, :, :)
    character(len=200) :: message
    integer :: stat
    allocate (field, source=linear_at(xyz))
    call begin(lod)
    allocate (narrow(2, 3), source=-5d0)
    call lod%transfer(field, narrow, stat=stat)
    call expect(stat == TETLOD_ERR_STATE, "no result yet")
    allocate (deep(2, 2, size(xyz, 2)), source=0d0)
    call lod%submit_field("deep", TETLOD_POINT_FIELD, deep, stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "0 components") > 0, "of rank 3: "//message)
    call lod%submit_field("short", TETLOD_POINT_FIELD, field(:, :10))
    call lod%run(stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "10 tuples") > 0, "too short: "//message)
    call lod%submit_field("short", TETLOD_POINT_FIELD, field)
    call lod%run()
    call lod%fetch_field("none", narrow, stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "none") > 0, "no such field: "//message)
    call lod%fetch_field("short", narrow, stat=stat)
    call expect(stat == TETLOD_ERR_BUFFER_SIZE .and. all(nint(narrow) == -5), "no room, nothing written")
    call lod%transfer(field(:1, :), narrow, stat=stat)
    call expect(stat /= TETLOD_OK .and. all(nint(narrow) == -5), "components differ")
    call lod%destroy()
  end subroutine

  ! The steps of a solver: the module hands on what the report counts.
  subroutine test_reuse()
    type(tetlod_context) :: lod
    type(tetlod_run_report) :: report
    call begin(lod)
    call lod%run()
    values = values + 0.1d0 * xyz(1, :)
    call lod%run()
    call lod%fetch_report(report)
    call expect(report%reused_tets == size(tets, 2), "the mesh is taken over")
    call lod%destroy()
  end subroutine
end module

program test_fields
  use field_tests
  implicit none
  call make_box(cells, xyz, tets)
  allocate (values, source=sin(4 * xyz(1, :)) + xyz(2, :) * xyz(3, :))
  call test_point_fields()
  call test_temporaries()
  call test_cell_fields()
  call test_steering()
  call test_stencils()
  call test_flags()
  call test_failures()
  call test_reuse()
  if (failures > 0) error stop "the field procedures of the module tetlod fail"
  print '("ok")'
end program
